"""The way in the air, and out of tissue: poses along it. Whether they may be sent is the gate's to say."""

from palpation_arm.poses import dot, minus, norm, plus, unit


def triple(row, prefix=""):
    return [row[prefix + axis] for axis in "xyz"]


def rotation(row):
    return [row["q" + axis] for axis in "xyzw"]


def approach(row):
    return triple(row, "approach_"), rotation(row)


def over_all(plan):
    """The mean normal, and how high along it every approach point of the plan lies at most, and half a standoff."""
    rows = plan["stops"] + plan["way"]
    normals = [triple(row, "normal_") for row in rows]
    up = unit([sum(axis) for axis in zip(*normals)])
    standoff = max(norm(minus(triple(row, "approach_"), triple(row))) for row in rows)
    return up, max(dot(up, triple(row, "approach_")) for row in rows) + standoff / 2


def way_to(plan, index, tip):
    """Poses to the approach point of a stop: as planned, over the tissue's shape, where the tip is at that of the stop before; else up, across and down."""
    stops = plan["stops"]
    goal = approach(stops[index])
    if index > 0 and norm(minus(tip, approach(stops[index - 1])[0])) < 0.001:
        return [approach(row) for row in plan["way"] if row["leg"] == index] + [goal]
    up, height = over_all(plan)
    lifted = plus(tip, up, max(0.0, height - dot(up, tip)))
    return [(lifted, goal[1]), (plus(goal[0], up, max(0.0, height - dot(up, goal[0]))), goal[1]), goal]


def stop_below(plan, tip):
    """The stop in whose way down the tip is, as after a death in the middle of a touch; None where it is in the air."""
    for stop in plan["stops"]:
        normal, above = triple(stop, "normal_"), minus(tip, triple(stop))
        height = dot(above, normal)
        standoff = norm(minus(triple(stop, "approach_"), triple(stop)))
        if norm(plus(above, normal, -height)) < 0.001 and -0.02 < height < 0.9 * standoff:
            return stop
    return None
