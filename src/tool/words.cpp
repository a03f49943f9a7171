#include "tool/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "palpation/belief/contact.h"
#include "palpation/belief/screening.h"
#include "palpation/boundary/level_remarks.h"
#include "palpation/boundary/level_set.h"
#include "palpation/certainty/reference_bound.h"
#include "tool/parts.h"

namespace palpation::tool {
namespace {

/// Below this probability a part is told as one that may not exist.
constexpr double kSure = 0.95;
constexpr double kMuchUntouched = 0.05;  // of the tissue

/// Expected wrong area beyond this part of the area found is told: the boundary is then hardly better than a guess.
constexpr double kLargeShare = 0.25;
constexpr double kMuchOverReachable = 5.0;  // times what readings can reach: that is worth a word
constexpr double kNoNoise = 1e-3;           // of the contrast: so little does not limit what they reach

std::string counted(std::size_t count, const std::string& noun) { return std::to_string(count) + " " + noun + (count == 1 ? "" : "s"); }

std::string no_level_words(const Exploration& exploration) { return exploration.trend_is_missing() ? kTooFewForTrend : kNoContrast; }

std::string percent(double probability) {
  const double value = 100.0 * probability;
  return fixed(value, value > 99.0 && value < 100.0 ? 1 : 0) + " %";
}

std::string part_words(const TumourPart& part) {
  const Vec2 size = (part.most_m - part.least_m) * 1e3;
  std::string words = "  " + fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " mm around " + place_words(part.position_m, 1);
  if (!part.polygon.holes.empty()) words += ", with " + counted(part.polygon.holes.size(), "hole");
  if (part.touches_border) words += ", reaching the border of the tissue";
  if (part.probability < kSure) words += ", tumour with probability " + percent(part.probability) + " only";
  return words + "\n";
}

/// What a surgeon asks: how far off the line may be, and where to cut.
std::string band_words(const Certainty& certainty, const Surface& surface, double cut_risk) {
  const double inner = superlevel_area(surface, certainty.score, certainty.band_score) * 1e6;
  const double outer = superlevel_area(surface, certainty.score, -certainty.band_score) * 1e6;
  const double cut = superlevel_area(surface, certainty.score, Certainty::cut_score(cut_risk)) * 1e6;
  return "With probability " + percent(certainty.probability) + " the whole outline lies in a band around this line, " +
         fixed(certainty.half_width_m * 1e3, 2) + " mm to either side on average: " + fixed(inner, 1) + " mm2 lie inside of the band, " +
         fixed(outer, 1) +
         " mm2 within its outer curve.\nExpected to be wrong: " + fixed(certainty.expected.symmetric_difference_m2() * 1e6, 1) + " mm2, " +
         fixed(certainty.expected.missed_m2 * 1e6, 1) + " missed and " + fixed(certainty.expected.extra_m2 * 1e6, 1) +
         " extra. To leave tumour at no place with more than " + percent(cut_risk) + " risk, cut around " + fixed(cut, 1) + " mm2.\n";
}

/// What is ruled out where nothing was found.
std::string nothing_words(const Episode& episode) {
  if (episode.exploration.trend_is_missing()) return "";
  const std::optional<double> diameter_m = diameter_ruled_out_m(episode);
  const std::string contrast = episode.assumed_contrast      ? "by " + reading_text(*episode.assumed_contrast) + " or more"
                               : episode.exploration.level() ? "so that its edge is at that level"
                                                             : "by four times the readings' scatter or more";
  if (!diameter_m) return "So few readings rule out no tumour that stands out " + contrast + ".\n";
  return "No tumour that stands out " + contrast + " is wider than " + fixed(*diameter_m * 1e3, 1) + " mm, with probability " +
         percent(episode.band_probability) + " wherever it might be.\n";
}

double area_found_m2(const Episode& episode) { return surface_area(episode.exploration.surface(), episode.estimate); }

std::string found_words(const Episode& episode) {
  if (episode.exploration.belief().site_count() == 0) return "No reading yet, so nothing is known.\n";
  if (!episode.exploration.level()) return no_level_words(episode.exploration) + "\n" + nothing_words(episode);
  const std::vector<TumourPart> parts = parts_of(episode);
  const std::string level = "at the level " + reading_text(episode.exploration.level()->value);
  if (parts.empty()) {
    if (episode.exploration.tip_hides_all()) return "Something stiff was felt, but it is nowhere wider than the probe's tip.\n";
    return "Nothing found " + level + ": no tissue is that stiff.\n" + nothing_words(episode);
  }
  std::string words =
      "Found " + counted(parts.size(), "stiff region") + " " + level + ", " + fixed(area_found_m2(episode) * 1e6, 1) + " mm2 in all:\n";
  for (const TumourPart& part : parts) words += part_words(part);
  words += band_words(*episode.exploration.certainty(), episode.exploration.surface(), episode.cut_risk);
  if (const std::optional<double> diameter_m = diameter_ruled_out_m(episode))
    words += "No other tumour that stands out " +
             (episode.assumed_contrast ? "by " + reading_text(*episode.assumed_contrast) + " or more" : std::string("as much")) +
             " is wider than " + fixed(*diameter_m * 1e3, 1) + " mm, with probability " + percent(episode.band_probability) + ".\n";
  return words;
}

std::string stop_words(const std::string& reason) {
  if (reason == "budget") return "Stopped because all planned batches are done.\n";
  if (reason == "expected error") return "Stopped because the expected wrong area is small enough.\n";
  if (reason == "band") return "Stopped because the band is narrow enough.\n";
  if (reason == "nothing to gain") return "Stopped because more readings would change little.\n";
  if (reason == "nothing left to touch") return "Stopped because no place is left to touch.\n";
  return "";
}

/// What a screen found, and whether the probe kept its contact.
std::vector<std::string> screening_remarks(const Exploration& exploration) {
  if (!exploration.is_screened()) return {};
  std::vector<std::string> remarks;
  for (const std::string& reason : {kJammed, kNoContact, kFrozen, kStartUp, kBaseStep, kOutlier}) {
    const std::vector<Palpation>& all = exploration.palpations();
    const auto count = std::count_if(all.begin(), all.end(), [&](const Palpation& one) { return one.set_aside == reason; });
    if (count > 0) remarks.push_back(counted(static_cast<std::size_t>(count), "reading") + " set aside (" + reason + ").");
  }
  if (const std::optional<FadingContact> fading = fading_contact(exploration.surface(), exploration.palpations()))
    remarks.push_back("Contact fades towards (" + fixed(fading->towards.x(), 2) + ", " + fixed(fading->towards.y(), 2) + ", " +
                      fixed(fading->towards.z(), 2) + "): healthy tissue reads " + percent(fading->base_fall) +
                      " of the contrast less at that end, where stiff tissue may be missed.");
  return remarks;
}

/// A level that is given, and that no reading comes near, decides before anything is felt.
std::string level_outside_words(const Exploration& exploration) {
  if (exploration.level()->stddev != 0.0) return "";
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Palpation& palpation : exploration.belief().detrended_palpations()) {
    if (!palpation.set_aside.empty()) continue;
    least = std::min(least, palpation.reading);
    greatest = std::max(greatest, palpation.reading);
  }
  const double level = exploration.level()->value;
  if (!(least < greatest) || (level > least && level < greatest)) return "";
  return "The level " + reading_text(level) + " lies " + (level > least ? "above" : "below") + " every reading, " + reading_text(least) +
         " to " + reading_text(greatest) + ": " + (level > least ? "nothing" : "all of the tissue") + " counts as stiff.";
}

std::string lone_reading_words(const Surface& surface, const Palpation& lone) {
  return "One reading, " + reading_text(lone.reading) + " at " + place_words(surface.position(lone.where), 1) +
         ", lies farther from all others than they lie from each other: touch there again, or take it out if it is a fault "
         "(field.screening "
         "sets aside what readings around it contradict).";
}

double perimeter_m(const Region& region) {
  double sum = 0.0;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) sum += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  };
  for (const PolygonWithHoles& polygon : region.polygons()) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return sum;
}

/// How many times as wrong the boundary is expected to be as one of that length by that many readings can be; nothing where its edge is
/// not known.
std::optional<double> over_reachable(const Episode& episode) {
  const std::optional<EdgeBelief>& edge = episode.exploration.edge();
  const double length_m = perimeter_m(episode.estimate);
  if (!edge || length_m == 0.0) return std::nullopt;
  const double contrast = std::abs(edge->profile().high - edge->profile().low), noise_sd = std::sqrt(edge->noise_variance());
  const ReferenceBound reachable = reference_bound({.perimeter_m = length_m,
                                                    .slope_per_m = edge->profile().slope_per_m,
                                                    .noise = noise_sd / contrast,
                                                    .readings = static_cast<int>(episode.exploration.palpations().size()),
                                                    .fraction = episode.level_fraction});
  const bool has_noise = noise_sd > kNoNoise * contrast;
  if (!has_noise || !(reachable.expected_error_m2 > 0.0)) return std::nullopt;
  return episode.exploration.certainty()->expected.symmetric_difference_m2() / reachable.expected_error_m2;
}

}  // namespace

std::string fixed(double value, int digits) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string reading_text(double value) {
  const double size = std::abs(value);
  if (size == 0.0 || (size >= 0.1 && size < 1e6)) return fixed(value, 3);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", size >= 1e6 && size < 1e15 ? 15 : 4, value);
  return text.data();
}

std::string place_words(const Vec3& place_m, int digits) {
  return "(" + fixed(place_m.x() * 1e3, digits) + ", " + fixed(place_m.y() * 1e3, digits) + ", " + fixed(place_m.z() * 1e3, digits) +
         ") mm";
}

std::string without(const std::string& start, const std::string& words) {
  return words.starts_with(start) ? words.substr(start.size()) : words;
}

std::vector<std::string> boundary_remarks(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  if (exploration.belief().site_count() == 0) return {};
  std::vector<std::string> remarks = screening_remarks(exploration);
  if (exploration.lone_reading()) remarks.push_back(lone_reading_words(exploration.surface(), *exploration.lone_reading()));
  if (exploration.lag() && exploration.lag()->at_bound) {
    remarks.push_back("The lag found, " + fixed(exploration.lag()->value_m * 1e3, 2) +
                      " mm, is as far as any was looked for: the readings do not tell it. Give field.lag_mm, or touch in more directions.");
  }
  if (!exploration.level()) {
    remarks.push_back(no_level_words(exploration));
    return remarks;
  }
  if (const double share = exploration.untouched_m2() / exploration.surface().area(); share > kMuchUntouched) {
    remarks.push_back(percent(share) + " of the tissue lies 8 mm or more from any reading: there nothing is sure.");
  }
  if (exploration.tip_hides_all())
    remarks.push_back(
        "What was felt is nowhere wider than the probe's tip, field.indenter_radius_mm: nothing is left once the tip is "
        "taken back, but something stiff is there.");
  if (const std::string outside = level_outside_words(exploration); !outside.empty()) remarks.push_back(outside);
  const Contour contour = exploration.contour();
  for (const std::string& remark : remarks_on_level_set(exploration.surface(), contour.field, contour.level).words())
    remarks.push_back(remark + '.');
  const std::vector<TumourPart> parts = parts_of(episode);
  if (!exploration.edge() && !parts.empty())
    remarks.push_back(
        "The level was not inferred from the tumour's edge: band, cut line and expected error are the field's alone, and not calibrated.");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].probability < kSure)
      remarks.push_back("Part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) + " is tumour with probability " +
                        percent(parts[i].probability) + " only.");
    if (parts[i].touches_border)
      remarks.push_back("Part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) +
                        " reaches the border of the tissue, beyond which it may go on.");
  }
  const std::optional<Certainty>& certainty = exploration.certainty();
  if (!parts.empty() && certainty && certainty->score.maxCoeff() < certainty->band_score)
    remarks.push_back("No place is tumour as good as surely: the band has no inner curve.");
  const double found_m2 = area_found_m2(episode);
  if (!parts.empty() && certainty && certainty->expected.symmetric_difference_m2() > kLargeShare * found_m2)
    remarks.push_back("The area expected to be wrong is " + percent(certainty->expected.symmetric_difference_m2() / found_m2) +
                      " of the area found: more readings are needed.");
  else if (const std::optional<double> times = over_reachable(episode); times && *times > kMuchOverReachable)
    remarks.push_back("The boundary is expected to be wrong by " + fixed(certainty->expected.symmetric_difference_m2() * 1e6, 1) +
                      " mm2, " + fixed(*times, 0) +
                      " times what as many readings with so little noise can reach at best: more batches would pay.");
  return remarks;
}

void tell(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::fprintf(stderr, "palpate: %s\n", warning.c_str());
}

std::string error_words(const RegionError& error, double search_area_m2, const std::string& against) {
  std::string words = against + ": " + fixed(error.symmetric_difference_m2 * 1e6, 2) + " mm2 wrong (" +
                      fixed(error.symmetric_difference_m2 * 1e4, 3) + " cm2, " +
                      fixed(100.0 * error.symmetric_difference_m2 / search_area_m2, 3) +
                      " % of the search area): " + fixed(error.missed_m2 * 1e6, 2) + " missed, " + fixed(error.extra_m2 * 1e6, 2) +
                      " extra; Dice " + fixed(error.dice, 3);
  if (error.hausdorff_m && error.mean_distance_m) {
    words += ", boundaries " + fixed(*error.mean_distance_m * 1e3, 2) + " mm apart on average, " + fixed(*error.hausdorff_m * 1e3, 2) +
             " at most";
  }
  return words + ".\n";
}

std::string batch_words(const Episode& episode) {
  const TraceRow& row = episode.trace.back();
  std::string words = counted(static_cast<std::size_t>(row.measurements), "reading");
  if (row.error) words += ", " + fixed(100.0 * row.error->symmetric_difference_m2 / episode.exploration.surface().area(), 3) + " % wrong";
  if (!episode.exploration.contrast_seen()) words += ", no contrast yet";
  return words;
}

std::string episode_words(const Episode& episode) {
  const std::size_t readings = episode.exploration.palpations().size();
  std::string words = counted(readings, "reading");
  if (episode.path_m > 0.0) words += " over a path of " + fixed(episode.path_m * 1e3, 0) + " mm";
  words += ".\n";
  if (!episode.stops.empty()) words += stop_words(episode.stop_reason());
  words += found_words(episode);
  if (episode.error) words += error_words(*episode.error, episode.exploration.surface().area(), "Against " + episode.truth_is);
  return words;
}

std::string plan_words(const Episode& episode, const std::vector<Waypoint>& stops, double path_m) {
  if (stops.empty()) return "Nothing more to touch. " + stop_words(episode.stop_reason());
  std::string words = "Touch next, in this order (" + fixed(path_m * 1e3, 0) + " mm to travel), in the robot's frame [mm]:\n";
  for (const Waypoint& stop : stops) {
    words += "  " + fixed(stop.position.x() * 1e3, 2) + "  " + fixed(stop.position.y() * 1e3, 2) + "  " +
             fixed(stop.position.z() * 1e3, 2) + "\n";
  }
  return words;
}

void finish_output(OutputFolder& output, bool quiet) {
  const std::optional<std::string> no_picture = output.draw();
  if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
  if (quiet) return;
  std::printf("Written to %s%s\n", output.folder().string().c_str(), no_picture ? "" : ", with picture.png");
}

}  // namespace palpation::tool
