#include "scene/misfit_words.h"

#include <algorithm>
#include <cmath>

#include "scene/session_words.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kReadingsTold = 3;
constexpr double kSamePlace_m = 1e-9;
constexpr double kTiltOver_m = 0.01;
constexpr double kMoreScatter = 1.1;  // times, surely

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

std::string tilt_words(ReadingScale scale, const Vec3& slope_per_m) {
  const double rise = slope_per_m.norm() * kTiltOver_m;
  const Vec3 way = slope_per_m.normalized();
  const std::string by = scale == ReadingScale::Log
                             ? "become " + fixed(std::exp(rise), 2) + " times as high"
                             : "rise by " + reading_text(rise);
  return "Readings slope all over the tissue: they " + by + " for each 10 mm towards " + "(" +
         fixed(way.x(), 2) + ", " + fixed(way.y(), 2) + ", " + fixed(way.z(), 2) + ")" +
         ". That is taken from them; where the tissue or the sensor is known to slope, set "
         "field.trend to linear.";
}

std::string waves_words(const Surface& surface, ReadingScale scale, const Field& waves) {
  Eigen::Index lowest = 0, highest = 0;
  const double rise = waves.maxCoeff(&highest) - waves.minCoeff(&lowest);
  const auto at = [&](Eigen::Index vertex) {
    return place_words(surface.vertex(static_cast<int>(vertex)), 1);
  };
  const std::string by = scale == ReadingScale::Log
                             ? "are " + fixed(std::exp(rise), 2) + " times as high at "
                             : "lie " + reading_text(rise) + " higher at ";
  return "Readings rise and fall slowly all over the tissue: without what has an edge they " + by +
         at(highest) + " than at " + at(lowest) + ". That is taken from them.";
}

std::string drift_words(ReadingScale scale, const Unevenness& background) {
  Eigen::Index lowest = 0, highest = 0;
  const double rise = background.drift.maxCoeff(&highest) - background.drift.minCoeff(&lowest);
  const std::string by = scale == ReadingScale::Log
                             ? "are " + fixed(std::exp(rise), 2) + " times as high"
                             : "lie " + reading_text(rise) + " higher";
  return "Readings rise and fall as time goes on, as a sensor that drifts makes them: wherever "
         "they "
         "are, they " +
         by + " about reading " + std::to_string(highest + 1) + " than about reading " +
         std::to_string(lowest + 1) +
         ". That is taken from them; where the way leads over the tissue as time goes on, tissue "
         "may do the same: touch again in another order.";
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
    case MisfitKind::WeakerPart:
      return "Something else lies at " + place_words(surface.position(*misfit.where), 1) + ": it " +
             standing_out_words(scale, misfit.amount) + ", which the outline does not hold" +
             doubt_words(conclusion, misfit) + (misfit.amount > 0.0 ? ". Touch there." : ".");
  }
  return "";
}

std::string taken_back_words(const Surface& surface, ReadingScale scale, const Misfit& change) {
  const std::string since =
      "Since reading " + std::to_string(change.number + 1) +
      (change.from_batch > 0 ? ", of batch " + std::to_string(change.from_batch) : "") + ", ";
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
    default:
      return since + "readings lie " + raised_words(scale, change.amount) +
             ", wherever they are: the sensor's zero has moved. That much is taken from "
             "them; set it again.";
  }
}

std::string errors_words(ReadingScale scale, const LastingErrors& errors) {
  return "Readings that were made one after the other err alike, over some " +
         fixed(errors.readings, 0) + " of them, by " +
         (scale == ReadingScale::Log ? percent(errors.sd) : reading_text(errors.sd)) +
         ", as a sensor that drifts makes them, or something that lies along the way. The band "
         "knows of it: touch again in another order to tell which.";
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

/// Nothing unless it surely does.
std::string scatter_words(const Conclusion& conclusion) {
  const DrawnNumber& inside = conclusion.outlines->noise_inside;
  if (inside.least < kMoreScatter) return "";
  return "Readings scatter " + fixed(inside.mean, 1) + " times as much (" + fixed(inside.least, 1) +
         " to " + fixed(inside.most, 1) + ") on the tumour as beside it, and count for less there" +
         (conclusion.model.contrast.scale == ReadingScale::Raw
              ? ": field.transform auto asks whether their logarithms fit better."
              : ".");
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

/// The reading that was made there, if it is one.
std::string reading_at(const Conclusion& conclusion, const SurfacePoint& where) {
  const Surface& surface = conclusion.belief.prior().surface();
  const Vec3 place = surface.position(where);
  for (const Palpation& one : conclusion.palpations) {
    if (one.set_aside.empty() && (surface.position(one.where) - place).norm() < kSamePlace_m)
      return reading_words(one.reading, place);
  }
  return "at " + place_words(place, 1);
}

std::string unheeded_words(const Conclusion& conclusion) {
  const std::vector<SurfacePoint>& unheeded = conclusion.outlines->misfit.unheeded;
  if (unheeded.empty()) return "";
  std::string words;
  for (std::size_t i = 0; i < std::min(unheeded.size(), kReadingsTold); ++i)
    words += (i > 0 ? ", " : "") + reading_at(conclusion, unheeded[i]);
  return counted(unheeded.size(), "reading") + (unheeded.size() == 1 ? " fits" : " fit") +
         " no outline and counted for nothing: " + words +
         (unheeded.size() > kReadingsTold ? ", ..." : "") +
         ". Touch there again: contact may have been lost, or something else lies there.";
}

}  // namespace

std::vector<std::string> misfit_words(const Conclusion& conclusion) {
  const Surface& surface = conclusion.belief.prior().surface();
  std::vector<std::string> words = session_words(conclusion);
  for (const Misfit& change : other_changes(conclusion)) {
    words.push_back(taken_back_words(surface, conclusion.scale(), change));
    if (change.kind == MisfitKind::Tilted && !session_changes(conclusion).empty())
      words.back() += " Sessions that felt other sides of it may differ by as much instead.";
  }
  if (const LastingErrors& errors = conclusion.evidence.errors_beside_edge;
      conclusion.outlines && errors.readings > 0.0 && !has_drift(conclusion))
    words.push_back(errors_words(conclusion.scale(), errors));
  if (conclusion.evidence.zero_or_tissue)
    words.push_back(zero_or_tissue_words(conclusion.scale(), *conclusion.evidence.zero_or_tissue));
  for (const Misfit& misfit : misfits(conclusion)) words.push_back(words_of(conclusion, misfit));
  if (conclusion.outlines) {
    words.push_back(unheeded_words(conclusion));
    words.push_back(scatter_words(conclusion));
    if (conclusion.outlines->core_matters())
      words.push_back(core_words(surface, *conclusion.outlines->core));
    if (!conclusion.outlines->misfit.do_agree())
      words.push_back(apart_words(conclusion.outlines->misfit.disagreement));
  }
  std::erase(words, "");
  return words;
}

}  // namespace palpation::tool
