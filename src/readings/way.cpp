#include "readings/way.h"

#include <numeric>

#include "palpation/geometry/path.h"
#include "palpation/readings/screening.h"
#include "readings/as_one.h"
#include "readings/passes.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr double kSameDirection = 0.999;  // cosine

}  // namespace

std::vector<Palpation> with_travel(const Surface& surface, std::vector<Palpation> palpations) {
  for (std::size_t i = 1; i < palpations.size(); ++i) {
    Palpation& one = palpations[i];
    const Palpation& before = palpations[i - 1];
    if (!one.travel.isZero(0.0) || one.session != before.session) continue;
    const Vec3 from = surface.position(before.where), to = surface.position(one.where);
    if (from != to) one.travel = (to - from).normalized();
  }
  return palpations;
}

bool follow_closely(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Vec3> places;
  for (const Palpation& one : palpations) places.push_back(surface.position(one.where));
  Pass all(places.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all.size() > 1 && median_step_m(places, all) < kShortLength_m;
}

std::vector<Palpation> merged_on_the_way(const Surface& surface,
                                         std::span<const Palpation> palpations, double within_m,
                                         double noise_variance) {
  std::vector<Palpation> merged;
  const auto may_merge = [&](const Palpation& palpation) {
    return palpation.kind == TouchKind::Way && palpation.set_aside.empty() &&
           variance_of(palpation, noise_variance) > 0.0;
  };
  for (std::size_t first = 0, end = 0; first < palpations.size(); first = end) {
    const Palpation& one = palpations[first];
    const Vec3 start = surface.position(one.where);
    const auto joins = [&](const Palpation& next) {
      return may_merge(one) && may_merge(next) && next.batch == one.batch &&
             next.session == one.session && next.bound == one.bound &&
             next.travel.dot(one.travel) > kSameDirection && are_alike(one, next, noise_variance) &&
             (surface.position(next.where) - start).norm() <= within_m;
    };
    end = first + 1;
    while (end < palpations.size() && joins(palpations[end])) ++end;
    merged.push_back(one);
    merged.back().number = made_of(palpations, first).number;
    if (end == first + 1) continue;
    auto [together, shift_m] =
        as_one(surface, palpations.subspan(first, end - first), noise_variance);
    together.number = merged.back().number;
    const double step = shift_m.norm();
    if (step > 0.0) {
      const std::vector<SurfacePoint> middle =
          way_between(surface, one.where, palpations[end - 1].where, step);
      if (!middle.empty()) together.where = middle.front();
    }
    merged.back() = std::move(together);
  }
  return merged;
}

}  // namespace palpation
