#include "scene/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "palpation/boundary/level_set.h"
#include "readings/readings.h"
#include "scene/parts.h"
#include "scene/status_line.h"

namespace palpation::tool {
namespace {

std::string part_words(const TumourPart& part) {
  const Vec2 size = (part.most_m - part.least_m) * 1e3;
  std::string words = "  " + fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " mm around " +
                      place_words(part.position_m, 1);
  if (!part.polygon.holes.empty()) words += ", with " + counted(part.polygon.holes.size(), "hole");
  if (part.touches_border) words += ", reaching the border of the tissue";
  if (part.probability && *part.probability < kSure)
    words += ", tumour with probability " + percent(*part.probability) + " only";
  if (part.contrast && part.contrast->stddev > 0.0)
    words += ", standing out by " + fixed(100.0 * part.contrast->of_strongest, 0) + " (sd " +
             fixed(100.0 * part.contrast->stddev, 0) +
             ") % of what the strongest does, and cut on its own way up";
  return words + "\n";
}

/// From a tenth of a square millimetre on.
std::string untouched_words(const Certainty& certainty) {
  const double wrong_mm2 = certainty.untouched_error_m2 * 1e6;
  return wrong_mm2 < 0.1 ? std::string()
                         : "; and " + fixed(wrong_mm2, 1) + " mm2 where nothing was touched";
}

/// What a surgeon asks: how far off the line may be, and where to cut.
std::string band_words(const Certainty& certainty, const Surface& surface, double cut_risk) {
  const double inner = superlevel_area(surface, certainty.score, certainty.band_score) * 1e6;
  const double outer = superlevel_area(surface, certainty.score, -certainty.band_score) * 1e6;
  const double cut =
      superlevel_area(surface, certainty.score, Certainty::cut_score(cut_risk)) * 1e6;
  const std::string half_width = certainty.half_width_m < std::sqrt(surface.area())
                                     ? fixed(certainty.half_width_m * 1e3, 2) + " mm"
                                     : "wider than the tissue";
  return percent(certainty.probability) + " confidence band: " + half_width +
         " to either side on average, " + fixed(inner, 1) + " mm2 within its inner curve, " +
         fixed(outer, 1) + " mm2 within its outer curve.\nExpected error: " +
         fixed(certainty.expected.symmetric_difference_m2() * 1e6, 1) + " mm2, " +
         fixed(certainty.expected.missed_m2 * 1e6, 1) + " missed and " +
         fixed(certainty.expected.extra_m2 * 1e6, 1) + " extra" + untouched_words(certainty) +
         ". Cut line: " + fixed(cut, 1) + " mm2; outside of it the risk of tumour is at most " +
         percent(cut_risk) + " at any place.\n";
}

bool has_least_contrast(const Episode& episode) {
  return episode.conclusion().model.contrast.least.has_value();
}

std::string least_contrast_words(const Episode& episode) {
  const Contrast& contrast = episode.conclusion().model.contrast;
  return std::string("by ") + (contrast.scale == ReadingScale::Log ? "a factor of " : "") +
         reading_text(*contrast.least) + " or more";
}

/// What is ruled out where nothing was found.
std::string nothing_words(const Episode& episode) {
  if (episode.conclusion().evidence.trend_is_missing) return "";
  const double noise_sd = scatter(episode.exploration);
  if (!episode.conclusion().level && noise_sd == 0.0) return "";
  const std::optional<double> diameter_m = diameter_ruled_out_m(episode);
  const std::string contrast =
      has_least_contrast(episode)  ? least_contrast_words(episode)
      : episode.conclusion().level ? "so that its edge is at that level"
      : episode.conclusion().scale() == ReadingScale::Log
          ? "by a factor of " + fixed(std::exp(4.0 * noise_sd), 2) +
                ", four times the scatter of the readings' logarithms, or more"
          : "by four times the readings' scatter, " + reading_text(4.0 * noise_sd) + ", or more";
  if (!diameter_m)
    return "These readings cannot rule out any tumour that stands out " + contrast + ".\n";
  return "No tumour that stands out " + contrast + " is wider than " + fixed(*diameter_m * 1e3, 1) +
         " mm, with probability " + percent(episode.band_probability()) +
         " wherever it might be.\n";
}

double area_found_m2(const Episode& episode) {
  return surface_area(episode.exploration.surface(), episode.estimate);
}

std::string found_words(const Episode& episode) {
  if (episode.conclusion().belief.site_count() == 0)
    return episode.conclusion().palpations.empty()
               ? "No readings yet, so nothing is known.\n"
               : "All readings are set aside, so nothing is known.\n";
  if (!episode.conclusion().level)
    return no_level_words(episode.exploration) + "\n" + nothing_words(episode);
  const std::vector<TumourPart> parts = parts_of(episode);
  const std::string level =
      "at the level " + reading_text(level_in_readings(episode.conclusion())->value);
  if (parts.empty()) {
    if (episode.conclusion().tip_hides_all())
      return "Something stiff was found, but it is nowhere wider than the probe's tip.\n";
    return "Nothing found " + level +
           (episode.conclusion().outlines ? ": no place is more likely tumour than not.\n"
                                          : ": no tissue is that stiff.\n") +
           nothing_words(episode);
  }
  std::string words = "Found " + counted(parts.size(), "stiff region") + " " + level + ", " +
                      fixed(area_found_m2(episode) * 1e6, 1) + " mm2 in total:\n";
  for (const TumourPart& part : parts) words += part_words(part);
  if (const std::optional<Certainty>& certainty = episode.conclusion().certainty)
    words += band_words(*certainty, episode.exploration.surface(), episode.cut_risk);
  else
    words += "How sure that is was not asked (certainty off).\n";
  if (const std::optional<double> diameter_m = diameter_ruled_out_m(episode))
    words +=
        "No other tumour that stands out " +
        (has_least_contrast(episode) ? least_contrast_words(episode) : std::string("as much")) +
        " is wider than " + fixed(*diameter_m * 1e3, 1) + " mm, with probability " +
        percent(episode.band_probability()) + ".\n";
  return words;
}

std::string stop_words(const std::string& reason) {
  if (reason == "budget") return "Stopped because all planned batches are done.\n";
  if (reason == "expected error")
    return "Stopped because the expected wrong area is small enough.\n";
  if (reason == "band") return "Stopped because the band is narrow enough.\n";
  if (reason == "nothing to gain") return "Stopped because more readings would change little.\n";
  if (reason == "nothing left to touch") return "Stopped because no place is left to touch.\n";
  return "";
}

}  // namespace

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string percent(double probability) {
  // What is neither impossible nor certain is told as neither.
  const double value = 100.0 * probability;
  if (value > 0.0 && value < 0.5)
    return fixed(value, static_cast<int>(std::ceil(-std::log10(value)))) + " %";
  if (value >= 99.95 && value < 100.0) return "over 99.9 %";
  return fixed(value, value > 99.0 && value < 100.0 ? 1 : 0) + " %";
}

std::string share_words(double share) {
  return share <= 1.0 ? percent(share) + " of" : fixed(share, 1) + " times";
}

std::string fixed(double value, int digits) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  const bool is_zero =
      std::string_view(text.data()).find_first_not_of("-0.") == std::string_view::npos;
  return text.data() + (is_zero && text[0] == '-' ? 1 : 0);
}

std::string reading_text(double value) {
  const double size = std::abs(value);
  if (size == 0.0 || (size >= 0.1 && size < 1e6)) return fixed(value, 3);
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", size >= 1e6 && size < 1e15 ? 15 : 4, value);
  return text.data();
}

std::string place_words(const Vec3& place_m, int digits) {
  return "(" + fixed(place_m.x() * 1e3, digits) + ", " + fixed(place_m.y() * 1e3, digits) + ", " +
         fixed(place_m.z() * 1e3, digits) + ") mm";
}

std::string without(const std::string& start, const std::string& words) {
  return words.starts_with(start) ? words.substr(start.size()) : words;
}

void tell(const std::vector<std::string>& warnings) {
  const auto held = StatusLine::wiped();
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "palpate: %s\n", warning.c_str());
}

std::string error_words(const RegionError& error, double search_area_m2,
                        const std::string& against) {
  std::string words = against + ": " + fixed(error.symmetric_difference_m2 * 1e6, 2) +
                      " mm2 wrong (" + fixed(error.symmetric_difference_m2 * 1e4, 3) + " cm2, " +
                      fixed(100.0 * error.symmetric_difference_m2 / search_area_m2, 3) +
                      " % of the search area): " + fixed(error.missed_m2 * 1e6, 2) + " missed, " +
                      fixed(error.extra_m2 * 1e6, 2) + " extra; Dice " + fixed(error.dice, 3);
  if (error.hausdorff_m && error.mean_distance_m) {
    words += ", boundaries " + fixed(*error.mean_distance_m * 1e3, 2) + " mm apart on average, " +
             fixed(*error.hausdorff_m * 1e3, 2) + " at most";
  }
  return words + ".\n";
}

std::string batch_words(const Episode& episode) {
  const TraceRow& row = episode.trace.back();
  std::string words = counted(static_cast<std::size_t>(row.measurements), "reading");
  if (row.error)
    words +=
        ", " +
        fixed(100.0 * row.error->symmetric_difference_m2 / episode.exploration.surface().area(),
              3) +
        " % wrong";
  if (!episode.conclusion().evidence.contrast_seen) words += ", no contrast yet";
  return words;
}

std::string episode_words(const Episode& episode) {
  const std::size_t readings = episode.conclusion().palpations.size();
  const auto set_aside = static_cast<std::size_t>(
      std::ranges::count_if(episode.conclusion().palpations,
                            [](const Palpation& one) { return !one.set_aside.empty(); }));
  std::string words = counted(readings, "reading");
  if (set_aside > 0) words += " (" + std::to_string(set_aside) + " set aside)";
  if (episode.course.length_m > 0.0)
    words += " over a path of " + fixed(episode.course.length_m * 1e3, 0) + " mm";
  words += ".\n";
  if (!episode.course.stops.empty()) words += stop_words(episode.stop_reason());
  words += found_words(episode);
  if (episode.error)
    words += error_words(*episode.error, episode.exploration.surface().area(),
                         "Against " + episode.truth_is);
  return words;
}

std::string goal_words(const Episode& episode) {
  const std::optional<GoalState> goal = goal_state(episode);
  if (!goal || goal->is_reached()) return "";
  const std::string size = fixed(goal->diameter_m * 1e3, 1) + " mm",
                    chance = percent(goal->probability);
  if (episode.conclusion().belief.site_count() == 0) return "";
  std::string words =
      "The search is not done: " +
      (goal->undetected_m ? "a tumour up to " + fixed(*goal->undetected_m * 1e3, 1) + " mm wide"
                          : std::string("a tumour of any width")) +
      " could still hide, and one of " + size + " was to be found with probability " + chance +
      " (plan.goal).";
  if (goal->touches_needed >= kMostTouchesCounted)
    words += " That takes a thousand more touches or more.";
  else if (goal->touches_needed > 0)
    words += " That takes about " + std::to_string(goal->touches_needed) +
             (goal->touches_needed == 1 ? " more touch." : " more touches.");
  else
    words += " What is left of it has its middle where no touch may be made.";
  return words;
}

std::string plan_words(const Episode& episode, const std::vector<Waypoint>& stops, double path_m) {
  if (stops.empty()) {
    const std::string left = goal_words(episode);
    return "Nothing more to touch. " + stop_words(episode.stop_reason()) +
           (left.empty() ? "" : left + "\n");
  }
  std::string words;
  if (const std::optional<GoalState> goal = goal_state(episode);
      goal && episode.conclusion().belief.site_count() == 0)
    words = "Readings of so much noise that a tumour stands out by four times it: " +
            (goal->touches_needed >= kMostTouchesCounted
                 ? std::string("a thousand touches or more")
                 : "about " + std::to_string(goal->touches_needed) + " touches") +
            " rule out one of " + fixed(goal->diameter_m * 1e3, 1) + " mm, with probability " +
            percent(goal->probability) + ".\n";
  words += "Touch next, in this order (" + fixed(path_m * 1e3, 0) +
           " mm to travel), in the robot's frame [mm]:\n";
  for (const Waypoint& stop : stops) {
    words += "  " + fixed(stop.position.x() * 1e3, 2) + "  " + fixed(stop.position.y() * 1e3, 2) +
             "  " + fixed(stop.position.z() * 1e3, 2) + "\n";
  }
  return words;
}

}  // namespace palpation::tool
