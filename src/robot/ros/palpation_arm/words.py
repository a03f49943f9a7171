"""What a person reads before the arm moves, and at the end."""


def in_mm(place):
    return "(" + ", ".join(f"{1000 * a:.1f}" for a in place) + ")"


def dry_run(opened, plan, limits):
    """Lines."""
    lines = [f"Remark: {remark}" for remark in opened["remarks"]]
    if not plan["stops"]:
        return [*lines, f"The session is finished: {plan['finished']}."]
    stops = [stop for stop in plan["stops"] if stop["state"] == "open"]
    lines += [
        f"Plan {plan['plan']}: {len(stops)} of {len(plan['stops'])} stops are open. Millimetres in the frame '{limits['frame']}':",
        f"  the tip stays in the box {in_mm(limits['box_least'])} to {in_mm(limits['box_most'])}",
        f"  where the tissue is: {limits['registration']}",
        f"  at most {1000 * limits['air_m_per_s']:g} mm/s in the air, {1000 * limits['contact_m_per_s']:g} mm/s at the tissue",
        f"  touches from {limits['contact_n']:g} N, goes back from {limits['warn_n']:g} N, holds from {limits['hold_n']:g} N",
        f"  the tissue is looked for within {1000 * limits['uncertainty_m']:g} mm of where it is taken to be, and {1000 * limits['extra_indent_m']:g} mm below",
        "  stop: approach -> tissue -> as deep as planned",
    ]
    for stop in stops:
        places = [in_mm([stop[prefix + axis] for axis in "xyz"]) for prefix in ("approach_", "", "indented_")]
        lines.append(f"  {stop['index']}: " + " -> ".join(places))
    return lines


def found(summary):
    parts = summary["parts"]
    return f"Found: {len(parts)} part(s), {summary['area_mm2']:.1f} mm2, from {summary['measurements']} readings" if parts else "Found nothing stiff"
