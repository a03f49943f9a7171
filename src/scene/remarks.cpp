#include "scene/remarks.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "boundary/level_remarks.h"
#include "certainty/contrast.h"
#include "palpation/base/error.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/misfit.h"
#include "palpation/readings/screening.h"
#include "readings/contact.h"
#include "readings/readings.h"
#include "readings/saturation.h"
#include "readings/way.h"
#include "scene/area_remarks.h"
#include "scene/misfit_words.h"
#include "scene/part_remarks.h"
#include "scene/parts.h"
#include "scene/session_words.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kPlacesNamed = 3;
constexpr double kLikely = 0.5;
constexpr double kMuchUntouched = 0.05;  // of the tissue
constexpr double kMuchPlane =
    0.5;  // of the readings' variance; a tumour over one half of the tissue gives three quarters
constexpr int kManySites = 1000;  // would be cheaper by reduced rank, if anything would

/// How many readings were set aside for a reason, and where the first of them are.
std::string set_aside_words(const Exploration& exploration, const std::string& reason) {
  std::size_t count = 0;
  std::string places;
  for (const Palpation& one : exploration.conclusion().palpations) {
    if (one.set_aside != reason || ++count > kPlacesNamed) continue;
    places += (places.empty() ? "" : ", ") +
              reading_words(one.reading, exploration.surface().position(one.where));
  }
  if (count == 0) return "";
  return counted(count, "reading") + " set aside (" + reason + "): " + places +
         (count > kPlacesNamed ? ", ..." : ".");
}

/// What a screen found, and whether the probe kept its contact.
std::vector<std::string> screening_remarks(const Exploration& exploration) {
  std::vector<std::string> remarks;
  for (const std::string& reason : kReasonsOfScans)
    remarks.push_back(set_aside_words(exploration, reason));
  for (const std::string& reason : kReasonsAnywhere)
    remarks.push_back(set_aside_words(exploration, reason));
  std::erase(remarks, "");
  if (!exploration.conclusion().model.field.probe.screening) return remarks;
  if (const std::optional<FadingContact> fading =
          fading_contact(exploration.surface(), readings_as_if_unchanged(exploration.conclusion())))
    remarks.push_back("Contact fades towards (" + fixed(fading->towards.x(), 2) + ", " +
                      fixed(fading->towards.y(), 2) + ", " + fixed(fading->towards.z(), 2) +
                      "): healthy tissue reads " + percent(fading->base_fall) +
                      " of the contrast less at that end, where stiff tissue may be missed.");
  return remarks;
}

/// Noise that is too low for the tolerance, or features that are no fewer than readings.
std::string reduced_rank_words(const Belief& belief) {
  const double tolerance = belief.options().reduced_rank_tolerance;
  if (tolerance == 0.0 || belief.reduced_rank() || belief.site_count() < kManySites) return "";
  const double noise = belief.noise_variance() / (belief.signal_sd() * belief.signal_sd());
  const std::string words = "field.reduced_rank is not in effect: ";
  if (noise >= kLeastNoiseForReducedRank * tolerance)
    return words + "it would take no fewer features than there are readings.";
  return words + "the noise's variance is " + text_of(noise) + " of the signal's, and must be " +
         text_of(kLeastNoiseForReducedRank) + " times the tolerance at least.";
}

/// A level that is given, and that no reading comes near, decides before anything is felt.
std::string level_outside_words(const Exploration& exploration) {
  if (exploration.conclusion().level->stddev != 0.0) return "";
  const std::vector<double> readings = readings_that_count(exploration);
  if (all_equal(readings)) return "";
  const auto [least, greatest] = std::ranges::minmax(readings);
  const double level = exploration.conclusion().level->value;
  if (level > least && level < greatest) return "";
  const auto text = [scale = exploration.conclusion().scale()](double value) {
    return reading_text(as_reading(scale, value));
  };
  return "The level " + text(level) + " lies " + (level > least ? "above" : "below") +
         " every reading, " + text(least) + " to " + text(greatest) + ": " +
         (level > least ? "nothing" : "all of the tissue") + " counts as stiff.";
}

std::string standing_alone_words(const Surface& surface, const std::vector<Palpation>& alone) {
  std::string words;
  for (const Palpation& one : alone) {
    words += (words.empty() ? "" : ", ") + reading_words(one.reading, surface.position(one.where));
  }
  const bool is_one = alone.size() == 1;
  words = (is_one ? "One reading, " + words + ", lies farther from all others than they lie"
                  : counted(alone.size(), "reading") + ", " + words +
                        ", lie farther from all others than those lie") +
          " from each other";
  return words + (alone.front().set_aside == kStandsAlone
                      ? std::string(", and ") + (is_one ? "is" : "are") +
                            " set aside: touch there again to confirm."
                      : std::string(": touch there again, or take ") + (is_one ? "it" : "them") +
                            " out if " + (is_one ? "it is a fault." : "they are faults."));
}

/// `is_drawn`: outlines know of it.
std::string saturation_words(const Saturation& saturation, bool is_drawn) {
  const std::string session =
      saturation.session ? " of the " + session_name(*saturation.session) : "";
  return std::to_string(saturation.count) + " readings" + session + " are exactly " +
         reading_text(saturation.value) + ", the " + (saturation.is_upper ? "greatest" : "least") +
         " of " + (saturation.session ? "its own" : "all") +
         ": the sensor's range may end there, and what lies beyond is not known" +
         (is_drawn ? std::string(": outlines are drawn for tissue that reads as much or ") +
                         (saturation.is_upper ? "more." : "less.")
                   : ".");
}

using Remarks = std::vector<std::string>;

/// Which way all were made, nearly, of readings that follow each other closely: as unit vectors
/// they add up to so much of their number.
constexpr double kOneWay = 0.8;

/// A lag shifts the outline as a whole then.
std::string one_way_words(const Conclusion& conclusion) {
  const std::vector<Palpation>& made = conclusion.palpations;
  if (!conclusion.level || conclusion.model.field.probe.has_lag() ||
      !follow_closely(conclusion.belief.prior().surface(), made))
    return "";
  Vec3 way = Vec3::Zero();
  for (const Palpation& one : made) way += one.travel / static_cast<double>(made.size());
  if (way.norm() < kOneWay) return "";
  way.normalize();
  return "Nearly all readings were made on the way towards (" + fixed(way.x(), 2) + ", " +
         fixed(way.y(), 2) + ", " + fixed(way.z(), 2) +
         "): if they come late, by backlash or a filter, the whole outline lies too far on that "
         "way, and nothing shows it. A few rows the other way would.";
}

/// Of the readings, and of the field that they make.
Remarks field_remarks(const Exploration& exploration) {
  const Conclusion& conclusion = exploration.conclusion();
  Remarks remarks;
  for (const Saturation& saturation : saturations_of(conclusion.palpations)) {
    const bool is_drawn = conclusion.outlines &&
                          std::ranges::any_of(conclusion.palpations, [&](const Palpation& one) {
                            return one.is_bound() && saturation.ends(one);
                          });
    remarks.push_back(saturation_words(saturation, is_drawn));
  }
  if (!conclusion.evidence.standing_alone.empty())
    remarks.push_back(
        standing_alone_words(exploration.surface(), conclusion.evidence.standing_alone));
  if (!conclusion.evidence.weaker.empty() && conclusion.level)
    remarks.push_back(
        "Weaker than plan.min_contrast, and so no tumour: " + weaker_words(exploration) + ".");
  if (const std::string words = reduced_rank_words(conclusion.belief); !words.empty())
    remarks.push_back(words);
  if (conclusion.lag && conclusion.lag->at_bound) {
    remarks.push_back("The lag found, " + fixed(conclusion.lag->value_m * 1e3, 2) +
                      " mm, is as far as any was looked for: the true one may lie beyond. Give "
                      "field.lag_mm, or touch in more directions.");
  }
  if (std::string words = one_way_words(conclusion); !words.empty())
    remarks.push_back(std::move(words));
  return remarks;
}

/// Of what the level cuts out.
Remarks level_remarks(const Exploration& exploration) {
  const Surface& surface = exploration.surface();
  const Conclusion& conclusion = exploration.conclusion();
  Remarks remarks;
  if (const std::optional<Certainty>& certainty = conclusion.certainty;
      certainty && certainty->untouched_m2 > kMuchUntouched * surface.area()) {
    remarks.push_back(percent(certainty->untouched_m2 / surface.area()) +
                      " of the tissue lies 8 mm or more from any reading: there nothing is sure.");
  }
  if (conclusion.tip_hides_all())
    remarks.push_back(
        "The stiff region is nowhere wider than the probe's tip (field.indenter_radius_mm): "
        "correcting for the tip leaves nothing, but something stiff is there.");
  if (const std::string outside = level_outside_words(exploration); !outside.empty())
    remarks.push_back(outside);
  const Contour& contour = *conclusion.contour;
  for (const std::string& remark :
       remarks_on_level_set(surface, contour.field, contour.level).words())
    remarks.push_back(remark + '.');
  // At an edge a slope was asked for.
  if (conclusion.belief.prior().has_slope() || conclusion.edge) return remarks;
  const double plane = explained_by_plane(surface, readings_as_if_unchanged(conclusion));
  if (plane > kMuchPlane)
    remarks.push_back(
        "A plane explains " + percent(plane) +
        " of how the readings differ: if that is a tilt or a drift, set field.trend to linear.");
  return remarks;
}

/// Where no place is inside in more than half of the outlines.
Remarks nothing_found_remarks(const Conclusion& conclusion) {
  if (!conclusion.outlines || conclusion.tip_hides_all()) return {};
  const double most_mm2 = std::ceil(conclusion.outlines->area_m2.most * 1e6);
  return {
      "Nowhere is it more probable than not that tissue is tumour, so nothing is drawn: it may "
      "hold none, or up to " +
      fixed(most_mm2, 0) + " mm2 that the readings do not place."};
}

Remarks found_remarks(const Conclusion& conclusion, const std::vector<TumourPart>& parts) {
  if (parts.empty()) return nothing_found_remarks(conclusion);
  Remarks remarks;
  const std::optional<Certainty>& certainty = conclusion.certainty;
  if (certainty && !conclusion.edge)
    remarks.push_back(
        "The level was not inferred from the tumour's edge: band, cut line and expected error are "
        "the field's alone, and not calibrated.");
  std::ranges::move(part_remarks(parts, conclusion), std::back_inserter(remarks));
  if (conclusion.outlines && conclusion.outlines->plateau_probability < kLikely)
    remarks.push_back(
        "The stiff region rises up to its middle (that it levels off is " +
        percent(conclusion.outlines->plateau_probability) +
        " probable): how stiff its core is was not felt, and something buried deep, or "
        "healthy tissue that stiffens by and by, feels alike.");
  if (const auto& odds = conclusion.evidence.of_edge; odds && odds->log_odds < surprising())
    remarks.push_back(instead_of_edge(*odds) + " explains the readings " +
                      (odds->log_odds < -surprising() ? "better" : "no worse") +
                      " than the edge that was found: it may be no tumour, or a tumour may lie "
                      "elsewhere.");
  if (certainty && certainty->score.maxCoeff() < certainty->band_score)
    remarks.push_back("No place is almost certainly tumour: the band has no inner curve.");
  return remarks;
}

}  // namespace

std::vector<std::string> boundary_remarks(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Conclusion& conclusion = episode.conclusion();
  Remarks remarks;
  if (std::string words = goal_words(episode); !words.empty()) remarks.push_back(std::move(words));
  std::ranges::move(screening_remarks(exploration), std::back_inserter(remarks));
  const auto add = [&](Remarks&& more) { std::ranges::move(more, std::back_inserter(remarks)); };
  if (conclusion.belief.site_count() == 0) {
    if (!conclusion.palpations.empty())
      remarks.push_back("No reading counts: of this tissue nothing is known.");
    return remarks;
  }
  add(field_remarks(exploration));
  if (!conclusion.level) {
    add(misfit_words(conclusion));
    remarks.push_back(no_level_words(exploration));
    return remarks;
  }
  add(level_remarks(exploration));
  const std::vector<TumourPart> parts = parts_of(episode);
  add(misfit_words(conclusion));
  add(found_remarks(conclusion, parts));
  add(area_remarks(episode, !parts.empty()));
  return remarks;
}

}  // namespace palpation::tool
