#include "certainty/detection.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/normal.h"
#include "base/sigmoid.h"
#include "certainty/detection_power.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kMostCentres = 2000;
/// Each a quarter wider than the one before: a disk between two of them loses a twentieth of its
/// excess at most.
constexpr std::array kWidths_m = {0.004, 0.005, 0.00625, 0.0078, 0.0098, 0.0122, 0.0153, 0.0191};
constexpr double kLikeness = 0.95;
constexpr double kSlope_per_m = 1200.0;  // as Sought's

/// Of a correlation: how rare it is among readings without any, as a normal deviate.
double excess_of(double correlation, double freedom) {
  return std::sqrt(-freedom * std::log1p(-std::min(correlation * correlation, 1.0 - 1e-15))) *
         (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0);
}

/// What must stand out so that the excess is as needed, though the disk itself adds to the
/// readings' scatter.
double needed_signal(std::size_t readings) {
  if (readings < 4) return std::numeric_limits<double>::infinity();
  const double freedom = static_cast<double>(readings) - 2.0;
  const double needed = kNeededToFind * (8.0 * freedom + 3.0) / (8.0 * freedom + 1.0);
  return std::sqrt(freedom * std::expm1(needed * needed / freedom)) / kLikeness;
}

class Power {
 public:
  Power(const Layout& layout, std::span<const Vec3> places, const Sought& sought)
      : layout_(layout),
        places_(places),
        slope_per_m_(sought.slope_per_m),
        needed_(needed_rises(places.size(), sought)) {}

  /// Whether a disk around a vertex is found surely enough. It grows with the radius.
  bool suffices(int vertex, double radius_m) const {
    const Vec3 centre = layout_.at(vertex);
    double sum = 0.0;
    bool touched = false;
    for (const Vec3& place : places_) {
      const double depth = radius_m - (place - centre).norm();
      if (depth < 0.0) continue;
      touched = true;
      sum += std::pow(rise_in_disk(depth, slope_per_m_), 2);
      if (sum >= needed_) return true;
    }
    return touched && sum >= needed_;
  }

 private:
  const Layout& layout_;
  std::span<const Vec3> places_;
  double slope_per_m_;
  double needed_;
};

/// A disk so large is found, one of `too_small_m` is not.
double least_radius_m(const Power& power, int vertex, double too_small_m, double enough_m) {
  while (enough_m - too_small_m > kRadiusResolution_m) {
    const double middle = 0.5 * (too_small_m + enough_m);
    (power.suffices(vertex, middle) ? enough_m : too_small_m) = middle;
  }
  return enough_m;
}

}  // namespace

void check(const Sought& sought, const std::string& function) {
  require(sought.contrast_to_noise > 0.0, function,
          "contrast_to_noise = " + text_of(sought.contrast_to_noise), "must be positive");
  require(std::isfinite(sought.slope_per_m) && sought.slope_per_m > 0.0, function,
          "slope_per_m = " + text_of(sought.slope_per_m), "must be positive and finite");
  require(sought.probability > 0.0 && sought.probability < 1.0, function,
          "probability = " + text_of(sought.probability), "must lie in (0, 1)");
}

double rise_in_disk(double depth_m, double slope_per_m) {
  return depth_m < 0.0 ? 0.0 : sigmoid(slope_per_m * depth_m);
}

double needed_rises(std::size_t readings, const Sought& sought) {
  if (std::isinf(sought.contrast_to_noise)) return 0.0;
  return std::pow(
      (needed_signal(readings) + normal_quantile(sought.probability)) / sought.contrast_to_noise,
      2);
}

double greatest_excess(const Layout& layout, std::span<const Vec3> places,
                       std::span<const double> readings) {
  require(places.size() == readings.size(), "greatest_excess", "places and readings",
          "must be as many");
  const auto count = static_cast<Eigen::Index>(readings.size());
  if (count < 4) return 0.0;
  Eigen::VectorXd deviation = Eigen::Map<const Eigen::VectorXd>(readings.data(), count);
  deviation.array() -= deviation.mean();
  const double scatter = deviation.norm();
  if (!(scatter > 0.0)) return 0.0;
  double greatest = 0.0;
  Eigen::VectorXd distances(count), rises(count);
  const int step = 1 + (layout.surface().vertex_count() - 1) / kMostCentres;
  for (int vertex = 0; vertex < layout.surface().vertex_count(); vertex += step) {
    for (Eigen::Index i = 0; i < count; ++i) distances[i] = (places[i] - layout.at(vertex)).norm();
    for (const double width_m : kWidths_m) {
      for (Eigen::Index i = 0; i < count; ++i)
        rises[i] = rise_in_disk(0.5 * width_m - distances[i], kSlope_per_m);
      const double spread = (rises.array() - rises.mean()).matrix().norm();
      if (spread > 0.0) greatest = std::max(greatest, rises.dot(deviation) / (spread * scatter));
    }
  }
  return excess_of(greatest, static_cast<double>(count) - 2.0);
}

std::optional<double> diameter_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                                           const Sought& sought) {
  std::vector<int> all(static_cast<std::size_t>(layout.surface().vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  return diameter_ruled_out_m(layout, places, sought, all);
}

std::optional<double> diameter_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                                           const Sought& sought, std::span<const int> centres) {
  check(sought, "diameter_ruled_out_m");
  const Power power(layout, places, sought);
  double radius_m = 0.0;
  for (const int vertex : centres) {
    if (power.suffices(vertex, radius_m)) continue;
    const double most_m = layout.surface().diameter();
    if (!power.suffices(vertex, most_m)) return std::nullopt;
    radius_m = least_radius_m(power, vertex, radius_m, most_m);
  }
  return 2.0 * radius_m;
}

Field diameters_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                            const Sought& sought, std::span<const int> centres) {
  check(sought, "diameters_ruled_out_m");
  const Power power(layout, places, sought);
  const double most_m = layout.surface().diameter();
  Field diameters = Field::Zero(layout.surface().vertex_count());
  for_ranges(static_cast<int>(centres.size()), 256, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const int vertex = centres[static_cast<std::size_t>(i)];
      const bool is_found = power.suffices(vertex, most_m);
      diameters[vertex] = 2.0 * (is_found ? least_radius_m(power, vertex, 0.0, most_m) : most_m);
    }
  });
  return diameters;
}

}  // namespace palpation
