#include "session/reading_checks.h"

#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/session/session.h"

namespace palpation {
namespace {

// As measurements.h has them.
constexpr double kGreatestReading = 1e30;
constexpr double kGreatestVariance = 1e60;
constexpr double kLeastVariance = 1e-60;
constexpr std::size_t kLongestWords = 200;

std::string text_of_point(const Vec3& point) {
  return "(" + text_of(point.x()) + ", " + text_of(point.y()) + ", " + text_of(point.z()) + ")";
}

bool is_same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

void check(const SessionReading& reading, const std::string& function) {
  require(reading.kind != TouchKind::Missed, function, "a missed stop", "is told by miss()");
  require(reading.place.allFinite(), function, "place " + text_of_point(reading.place),
          "must be finite, in metres");
  require(std::abs(reading.reading) <= kGreatestReading, function,
          "reading " + text_of(reading.reading), "must be finite and at most 1e30 in size");
  const double variance = reading.noise_variance;
  require(std::isnan(variance) || variance == 0.0 ||
              (variance >= kLeastVariance && variance <= kGreatestVariance),
          function, "noise_variance " + text_of(variance), "must be 0, or 1e-60 to 1e60");
  require(reading.travel.isZero(0.0) ||
              (reading.travel.allFinite() && std::abs(reading.travel.norm() - 1.0) <= 1e-6),
          function, "travel " + text_of_point(reading.travel), "must be a unit vector, or zero");
  require(!reading.t_s || std::isfinite(*reading.t_s), function, "time",
          "must be finite, in seconds");
}

std::string one_line(const std::string& words, const std::string& standard) {
  std::string line = words.substr(0, kLongestWords);
  std::ranges::replace_if(
      line, [](char letter) { return static_cast<unsigned char>(letter) < ' '; }, ' ');
  const bool is_blank = line.find_first_not_of(' ') == std::string::npos;
  return is_blank ? standard : line;
}

bool is_same(const SessionReading& a, const SessionReading& b) {
  return a.kind == b.kind && a.place == b.place && a.reading == b.reading &&
         is_same_number(a.noise_variance, b.noise_variance) && a.travel == b.travel &&
         a.t_s == b.t_s && (!a.stop || !b.stop || *a.stop == *b.stop);
}

std::optional<int> nearest_stop(const Vec3& on_tissue, const std::vector<int>& open,
                                const std::vector<Vec3>& stops) {
  std::optional<int> nearest;
  double least_m = kStopReach_m;
  for (const int stop : open) {
    const double away_m = (stops[static_cast<std::size_t>(stop)] - on_tissue).norm();
    if (away_m > least_m || (nearest && away_m == least_m)) continue;
    nearest = stop;
    least_m = away_m;
  }
  return nearest;
}

}  // namespace palpation
