#include "scene/misfit_words.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "scene/background_words.h"
#include "scene/scatter_words.h"
#include "scene/session_words.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kReadingsTold = 3;
constexpr double kSamePlace_m = 1e-9;

std::string apart_words(double disagreement) {
  return "Two samplings of the outline have not come to one answer: they lie " +
         fixed(disagreement, 1) +
         " standard deviations apart, so the band may be too narrow. More readings would settle "
         "it.";
}

std::string since_words(const Misfit& misfit) {
  return "From batch " + std::to_string(misfit.from_batch) + " on ";
}

std::string standing_out_words(ReadingScale scale, double amount) {
  if (scale == ReadingScale::Log)
    return "reads " + fixed(std::exp(amount), 2) + " times as much as tissue around it";
  return (amount > 0.0 ? "stands out by " : "reads less by ") + reading_text(std::abs(amount));
}

std::string late_words(double lag_m) {
  return "Readings are of places " + fixed(std::abs(lag_m) * 1e3, 1) + " mm " +
         (lag_m > 0.0 ? "behind" : "ahead of") +
         " where they were made, along the way on which the probe came there, as backlash, a "
         "filter or a pose that comes late makes them";
}

std::string another_outline_words(const Conclusion& conclusion, const Misfit& since) {
  const Surface& surface = conclusion.belief.prior().surface();
  const std::string who = since.session > 0
                              ? "Readings of the " + session_name(since.session) + " and later"
                              : "Readings since number " + std::to_string(since.number + 1);
  return who + " put the outline elsewhere than those before, at " +
         place_words(surface.position(*since.where), 1) + " by " +
         fixed(std::abs(since.amount) * 1e3, 1) + " mm " +
         (since.amount > 0.0 ? "outwards" : "inwards") +
         ", and neither a zero, a gain nor a shift explains it: the probe's tip, the scale or turn "
         "of its registration, or the tissue is another. The outline is of both: take one or the "
         "other out.";
}

/// Of what may be tumour.
std::string doubt_words(const Conclusion& conclusion, const Misfit& misfit) {
  const Surface& surface = conclusion.belief.prior().surface();
  for (const DoubtfulPart& part : conclusion.evidence.doubtful) {
    if (surface.position(part.where) == surface.position(*misfit.where))
      return ". It may be tumour or not: its " + fixed(part.area_m2 * 1e6, 0) +
             " mm2 lie in the band, and half of them count as missed";
  }
  return "";
}

std::string words_of(const Conclusion& conclusion, const Misfit& misfit) {
  const Surface& surface = conclusion.belief.prior().surface();
  const ReadingScale scale = conclusion.scale();
  switch (misfit.kind) {
    case MisfitKind::Zero:
      return since_words(misfit) + "readings lie " + raised_words(scale, misfit.amount) +
             ", wherever they are: set the sensor's zero again and touch anew, or take "
             "the earlier ones out.";
    case MisfitKind::Gain:
      return since_words(misfit) + "what stands out does so " + fixed(1.0 + misfit.amount, 2) +
             " times as much as before: the sensor or the contact has changed.";
    case MisfitKind::Moved:
      return "In or before batch " + std::to_string(misfit.from_batch) +
             " the tissue moved, or its registration did: readings since then fit it " +
             fixed(misfit.amount * 1e3, 1) + " mm from where it lay, shifted by " +
             place_words(misfit.moved_m, 1) +
             ". Register it again and touch anew, or take the readings before or since out: the "
             "outline is of both.";
    case MisfitKind::Tilted:
      return tilt_words(scale, misfit.background.slope_per_m);
    case MisfitKind::Waves:
      return waves_words(surface, scale, misfit.background.waves);
    case MisfitKind::Drift:
      return drift_words(scale, misfit.background);
    case MisfitKind::Late:
      return late_words(misfit.amount) + ", or nearly so: the outline does not know of it.";
    case MisfitKind::Outline:
      return another_outline_words(conclusion, misfit);
    case MisfitKind::WeakerPart:
      return "Something else lies at " + place_words(surface.position(*misfit.where), 1) + ": it " +
             standing_out_words(scale, misfit.amount) + ", which the outline does not hold" +
             doubt_words(conclusion, misfit) + (misfit.amount > 0.0 ? ". Touch there." : ".");
  }
  return "";
}

/// The session that it begins, or its batch.
std::string of_when(std::span<const Palpation> palpations, const Misfit& change) {
  const std::size_t number = change.number;
  if (number > 0 && number < palpations.size() &&
      palpations[number].session != palpations[number - 1].session)
    return ", with which the " + session_name(palpations[number].session) + " begins";
  return change.from_batch > 0 ? ", of batch " + std::to_string(change.from_batch) : "";
}

std::string taken_back_words(const Conclusion& conclusion, const Misfit& change) {
  const Surface& surface = conclusion.belief.prior().surface();
  const ReadingScale scale = conclusion.scale();
  const std::string since = "Since reading " + std::to_string(change.number + 1) +
                            of_when(conclusion.palpations, change) + ", ";
  switch (change.kind) {
    case MisfitKind::Gain:
      return since + "what stands out does so " + fixed(1.0 + change.amount, 2) +
             " times as much as before: the sensor or the contact has changed. Readings since then "
             "are taken as they would have been; calibrate it again.";
    case MisfitKind::Moved:
      return since + "the tissue lies " + fixed(change.amount * 1e3, 1) +
             " mm from where it lay, shifted by " + place_words(change.moved_m, 1) +
             ", or its registration is off by that. Readings since then are taken to be of where "
             "it lay before, and so is the outline; register it again.";
    case MisfitKind::Tilted:
      return tilt_words(scale, change.background.slope_per_m);
    case MisfitKind::Waves:
      return waves_words(surface, scale, change.background.waves);
    case MisfitKind::Drift:
      return drift_words(scale, change.background);
    case MisfitKind::Late:
      return late_words(change.amount) +
             ". They are taken to be of there, and so is the outline; field.lag_mm says so "
             "beforehand. Were it backlash, and the robot registered while it went one way, the "
             "whole outline would lie " +
             fixed(std::abs(change.amount) * 1e3, 1) + " mm to one side: nothing tells.";
    default:
      return since + "readings lie " + raised_words(scale, change.amount) +
             ", wherever they are: the sensor's zero has moved. That much is taken from "
             "them; set it again.";
  }
}

bool has_drift(const Conclusion& conclusion) {
  return std::ranges::find(conclusion.evidence.taken_back, MisfitKind::Drift, &Misfit::kind) !=
         conclusion.evidence.taken_back.end();
}

std::string zero_or_tissue_words(ReadingScale scale, const Misfit& step) {
  return "Since reading " + std::to_string(step.number + 1) + " readings lie " +
         raised_words(scale, step.amount) +
         ", and since then the ground is another, too: that tissue differs there, or that the "
         "sensor's zero moved, the readings do not tell. It is taken for tissue; touch again "
         "where you touched before.";
}

std::string ways_words(const DrawnNumber& lasting) {
  if (lasting.most < 0.5)
    return "most of it each by a way of its own, as tissue that breathes faster than it is "
           "touched, or poses that are rough, make them";
  if (lasting.least > 0.5)
    return "most of it by ways that last over some readings, as tissue that breathes or sags, or "
           "an arm whose calibration drifts, makes them";
  return "as tissue that breathes, poses that are rough, or an arm whose calibration drifts make "
         "them";
}

/// Nothing unless they surely do.
std::string wandering_words(const WanderingPlaces& wandering) {
  if (!wandering.is_sure()) return "";
  return "Readings were made " + fixed(wandering.way_m.mean * 1e3, 1) + " mm (" +
         fixed(wandering.way_m.least * 1e3, 1) + " to " + fixed(wandering.way_m.most * 1e3, 1) +
         ") from where they are said to be, root mean square, " + ways_words(wandering.lasting) +
         "; number " + std::to_string(wandering.farthest + 1) + " the farthest, by " +
         fixed(wandering.farthest_m * 1e3, 1) +
         " mm. The outline and its band know that: what would make them sharper is tissue that "
         "is still, and poses that are right.";
}

std::string core_words(const Surface& surface, const DrawnCore& core) {
  if (core.probability < 1.0)
    return "Whether the stiff region is of one height, " + fixed(core.without_m2 * 1e6, 0) +
           " mm2, or a core around " + place_words(surface.position(core.where), 1) +
           " in softer tumour, " + fixed(core.with_m2 * 1e6, 0) +
           " mm2 with it, is not sure: of the outlines that the readings leave " +
           fixed(100.0 * core.probability, 0) +
           " % have a core, and the band is of both. Touches between the two would tell.";
  return "The stiff region has a core of " + fixed(core.area_m2.mean * 1e6, 0) + " mm2 around " +
         place_words(surface.position(core.where), 1) + "; beside it tissue stands out " +
         fixed(core.beside.mean, 2) + " times as much (" + fixed(core.beside.least, 2) + " to " +
         fixed(core.beside.most, 2) + "). The outline holds both, and goes half way up to either.";
}

/// The readings, as they were made, that are taken to be of these places; null of others.
std::vector<const Palpation*> made_at(const Conclusion& conclusion,
                                      std::span<const SurfacePoint> places) {
  const Surface& surface = conclusion.belief.prior().surface();
  const std::vector<Palpation> taken = readings_as_if_unchanged(conclusion);
  std::vector<const Palpation*> made;
  for (const SurfacePoint& where : places) {
    const auto one = std::ranges::find_if(taken, [&](const Palpation& other) {
      return other.set_aside.empty() &&
             (surface.position(other.where) - surface.position(where)).norm() < kSamePlace_m;
    });
    made.push_back(one == taken.end() ? nullptr : &conclusion.palpations[one - taken.begin()]);
  }
  return made;
}

/// What makes such readings: a lost contact reads low.
std::string cause_words(const std::optional<Level>& level,
                        std::span<const Palpation* const> readings) {
  const auto are_all = [&](const auto& is_so) {
    return level && std::ranges::all_of(readings, [&](const Palpation* one) {
             return one != nullptr && is_so(one->reading);
           });
  };
  if (are_all([&](double reading) { return reading > level->value; }))
    return "something stiffer may lie there";
  if (are_all([&](double reading) { return reading < level->value; }))
    return "contact may have been lost, or something softer lies there";
  return "contact may have been lost, or something else lies there";
}

std::string unheeded_words(const Conclusion& conclusion) {
  const std::vector<SurfacePoint>& unheeded = conclusion.outlines->misfit.unheeded;
  if (unheeded.empty()) return "";
  const Surface& surface = conclusion.belief.prior().surface();
  const std::vector<const Palpation*> made = made_at(conclusion, unheeded);
  std::string words;
  for (std::size_t i = 0; i < std::min(unheeded.size(), kReadingsTold); ++i) {
    words += i > 0 ? ", " : "";
    words += made[i] != nullptr ? reading_words(made[i]->reading, surface.position(made[i]->where))
                                : "at " + place_words(surface.position(unheeded[i]), 1);
  }
  return counted(unheeded.size(), "reading") + (unheeded.size() == 1 ? " fits" : " fit") +
         " no outline and counted for nothing: " + words +
         (unheeded.size() > kReadingsTold ? ", ..." : "") +
         ". Touch there again: " + cause_words(level_in_readings(conclusion), made) + ".";
}

}  // namespace

std::vector<std::string> misfit_words(const Conclusion& conclusion) {
  const Surface& surface = conclusion.belief.prior().surface();
  std::vector<std::string> words = session_words(conclusion);
  words.push_back(scale_words(conclusion));
  for (const Misfit& change : other_changes(conclusion)) {
    words.push_back(taken_back_words(conclusion, change));
    if (change.kind == MisfitKind::Tilted && !session_changes(conclusion).empty())
      words.back() += " Sessions that felt other sides of it may differ by as much instead.";
  }
  if (const LastingErrors& errors = conclusion.evidence.errors_beside_edge;
      conclusion.outlines && errors.readings > 0.0 && !has_drift(conclusion))
    words.push_back(errors_words(conclusion.scale(), errors));
  if (conclusion.evidence.zero_or_tissue)
    words.push_back(zero_or_tissue_words(conclusion.scale(), *conclusion.evidence.zero_or_tissue));
  if (conclusion.evidence.another_outline)
    words.push_back(another_outline_words(conclusion, *conclusion.evidence.another_outline));
  for (const Misfit& misfit : misfits(conclusion)) words.push_back(words_of(conclusion, misfit));
  if (conclusion.outlines) {
    words.push_back(unheeded_words(conclusion));
    words.push_back(more_scatter_words(conclusion));
    if (conclusion.outlines->misfit.wandering)
      words.push_back(wandering_words(*conclusion.outlines->misfit.wandering));
    if (conclusion.outlines->core_matters())
      words.push_back(core_words(surface, *conclusion.outlines->core));
    if (!conclusion.outlines->misfit.do_agree())
      words.push_back(apart_words(conclusion.outlines->misfit.disagreement));
  }
  std::erase(words, "");
  return words;
}

}  // namespace palpation::tool
