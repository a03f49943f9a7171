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
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kResolution_m = 1e-5;
constexpr int kMostCentres = 2000;
/// Each a quarter wider than the one before: a disk between two of them loses a twentieth of its
/// excess at most.
constexpr std::array kWidths_m = {0.004, 0.005, 0.00625, 0.0078, 0.0098, 0.0122, 0.0153, 0.0191};
constexpr double kLikeness = 0.95;
constexpr double kSlope_per_m = 1200.0;  // as Sought's

double rise(double depth_m, double slope_per_m) {
  return depth_m < 0.0 ? 0.0 : sigmoid(slope_per_m * depth_m);
}

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
        needed_(
            std::isinf(sought.contrast_to_noise)
                ? 0.0
                : std::pow((needed_signal(places.size()) + normal_quantile(sought.probability)) /
                               sought.contrast_to_noise,
                           2)) {}

  /// Whether a disk around a vertex is found surely enough. It grows with the radius.
  bool suffices(int vertex, double radius_m) const {
    const Vec3 centre = layout_.at(vertex);
    double sum = 0.0;
    bool touched = false;
    for (const Vec3& place : places_) {
      const double depth = radius_m - (place - centre).norm();
      if (depth < 0.0) continue;
      touched = true;
      sum += std::pow(rise(depth, slope_per_m_), 2);
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

}  // namespace

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
        rises[i] = rise(0.5 * width_m - distances[i], kSlope_per_m);
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
  require(sought.contrast_to_noise > 0.0, "diameter_ruled_out_m",
          "contrast_to_noise = " + text_of(sought.contrast_to_noise), "must be positive");
  require(std::isfinite(sought.slope_per_m) && sought.slope_per_m > 0.0, "diameter_ruled_out_m",
          "slope_per_m = " + text_of(sought.slope_per_m), "must be positive and finite");
  require(sought.probability > 0.0 && sought.probability < 1.0, "diameter_ruled_out_m",
          "probability = " + text_of(sought.probability), "must lie in (0, 1)");
  const Power power(layout, places, sought);
  double radius_m = 0.0;
  for (const int vertex : centres) {
    if (power.suffices(vertex, radius_m)) continue;
    double too_small = radius_m, enough = layout.surface().diameter();
    if (!power.suffices(vertex, enough)) return std::nullopt;
    while (enough - too_small > kResolution_m) {
      const double middle = 0.5 * (too_small + enough);
      (power.suffices(vertex, middle) ? enough : too_small) = middle;
    }
    radius_m = enough;
  }
  return 2.0 * radius_m;
}

}  // namespace palpation
