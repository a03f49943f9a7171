// Where to touch so that no tumour of a size can hide.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "certainty/detection.h"
#include "certainty/detection_power.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr std::size_t kMostLookedAt = 2000;
constexpr double kEnough = 1e-12;
/// Of fewer readings the scatter is not known; those to come are readings, too.
constexpr std::size_t kReadingsToBe = 30;

/// Every so many, so that there are no more than are looked at.
std::vector<int> thinned(std::span<const int> vertices) {
  const std::size_t step = 1 + (vertices.empty() ? 0 : (vertices.size() - 1) / kMostLookedAt);
  std::vector<int> kept;
  for (std::size_t i = 0; i < vertices.size(); i += step) kept.push_back(vertices[i]);
  return kept;
}

std::vector<Vec3> places_of(const Layout& layout, std::span<const int> vertices) {
  std::vector<Vec3> places;
  for (const int vertex : vertices) places.push_back(layout.at(vertex));
  return places;
}

/// What is lacking at each centre until a disk around it would be found, and what a touch takes
/// away of its squares: the most where the most is lacking, so that touches spread before they come
/// to the same places again.
class Lack {
 public:
  Lack(std::vector<Vec3> centres, const Sought& sought, double radius_m, std::size_t readings)
      : centres_(std::move(centres)),
        // A single touch finds what has no noise: at the rim it rises by a half.
        lack_(centres_.size(),
              std::max(needed_rises(std::max(readings, kReadingsToBe), sought), 0.25)),
        radius_m_(radius_m),
        slope_per_m_(sought.slope_per_m) {}

  double taken_by(const Vec3& touch) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < centres_.size(); ++i) {
      const double taken = std::min(lack_[i], squared_rise(i, touch));
      sum += taken * (2.0 * lack_[i] - taken);
    }
    return sum;
  }
  /// Of the centres where something is lacking, as many as are looked at.
  void keep_some() {
    std::vector<int> lacking;
    for (std::size_t i = 0; i < lack_.size(); ++i) {
      if (lack_[i] > 0.0) lacking.push_back(static_cast<int>(i));
    }
    std::vector<Vec3> centres;
    std::vector<double> lack;
    for (const int i : thinned(lacking)) {
      centres.push_back(centres_[static_cast<std::size_t>(i)]);
      lack.push_back(lack_[static_cast<std::size_t>(i)]);
    }
    centres_ = std::move(centres);
    lack_ = std::move(lack);
  }
  bool reaches(const Vec3& touch) const {
    return std::ranges::any_of(
        centres_, [&](const Vec3& centre) { return (touch - centre).norm() <= radius_m_; });
  }
  void take(const Vec3& touch) {
    for (std::size_t i = 0; i < centres_.size(); ++i)
      lack_[i] = std::max(0.0, lack_[i] - squared_rise(i, touch));
  }

 private:
  double squared_rise(std::size_t centre, const Vec3& touch) const {
    const double depth_m = radius_m_ - (touch - centres_[centre]).norm();
    return depth_m < 0.0 ? 0.0 : std::pow(rise_in_disk(depth_m, slope_per_m_), 2);
  }

  std::vector<Vec3> centres_;
  std::vector<double> lack_;
  double radius_m_;
  double slope_per_m_;
};

}  // namespace

std::vector<int> touches_to_rule_out(const Layout& layout, std::span<const Vec3> places,
                                     const Sought& sought, double diameter_m,
                                     std::span<const int> centres, const FurtherTouches& further) {
  check(sought, "touches_to_rule_out");
  require(std::isfinite(diameter_m) && diameter_m > 0.0, "touches_to_rule_out",
          "diameter_m = " + text_of(diameter_m), "must be positive and finite");
  Lack lack(places_of(layout, centres), sought, 0.5 * diameter_m, places.size());
  for (const Vec3& place : places) lack.take(place);
  lack.keep_some();
  std::vector<int> near;
  std::ranges::copy_if(further.candidates, std::back_inserter(near),
                       [&](int vertex) { return lack.reaches(layout.at(vertex)); });
  const std::vector<int> candidates = thinned(near);
  const std::vector<Vec3> at = places_of(layout, candidates);
  std::vector<double> takes;
  for (const Vec3& place : at) takes.push_back(lack.taken_by(place));
  std::vector<int> touches;
  while (touches.size() < further.most && !takes.empty()) {
    const auto best = static_cast<std::size_t>(std::ranges::max_element(takes) - takes.begin());
    if (!(takes[best] > kEnough)) break;
    touches.push_back(candidates[best]);
    lack.take(at[best]);
    // What a touch takes is shared with those that reach the same centres.
    for (std::size_t i = 0; i < at.size(); ++i) {
      if ((at[i] - at[best]).norm() <= 2.0 * diameter_m) takes[i] = lack.taken_by(at[i]);
    }
  }
  return touches;
}

}  // namespace palpation
