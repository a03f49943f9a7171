#include "readings/way.h"

#include <cmath>

#include "palpation/geometry/path.h"

namespace palpation {
namespace {

constexpr double kSameDirection = 0.999;  // cosine
/// Standard deviations of a difference of two: 95 % of those of one plateau differ by less.
constexpr double kAlike = 2.0;

}  // namespace

std::vector<Palpation> merged_on_the_way(const Surface& surface,
                                         std::span<const Palpation> palpations, double within_m,
                                         double noise_variance) {
  std::vector<Palpation> merged;
  const auto variance_of = [&](const Palpation& palpation) {
    return std::isnan(palpation.noise_variance) ? noise_variance : palpation.noise_variance;
  };
  const auto may_merge = [&](const Palpation& palpation) {
    return palpation.kind == TouchKind::Way && palpation.set_aside.empty() &&
           variance_of(palpation) > 0.0;
  };
  for (std::size_t first = 0, end = 0; first < palpations.size(); first = end) {
    const Palpation& one = palpations[first];
    const Vec3 start = surface.position(one.where);
    const auto joins = [&](const Palpation& next) {
      return may_merge(one) && may_merge(next) && next.batch == one.batch &&
             next.session == one.session && next.travel.dot(one.travel) > kSameDirection &&
             std::abs(next.reading - one.reading) <=
                 kAlike * std::sqrt(variance_of(one) + variance_of(next)) &&
             (surface.position(next.where) - start).norm() <= within_m;
    };
    end = first + 1;
    while (end < palpations.size() && joins(palpations[end])) ++end;
    merged.push_back(one);
    if (end == first + 1) continue;
    merged.back().count = 0;
    double precision = 0.0, offset = 0.0;
    Vec3 shift = Vec3::Zero();
    for (const Palpation& palpation : palpations.subspan(first, end - first)) {
      const double weight = 1.0 / variance_of(palpation);
      merged.back().count += palpation.count;
      precision += weight;
      offset += weight * (palpation.reading - one.reading);
      shift += weight * (surface.position(palpation.where) - start);
    }
    const double step = (shift / precision).norm();
    if (step > 0.0) {
      const std::vector<SurfacePoint> middle =
          way_between(surface, one.where, palpations[end - 1].where, step);
      if (!middle.empty()) merged.back().where = middle.front();
    }
    merged.back().reading = one.reading + offset / precision;
    merged.back().noise_variance = 1.0 / precision;
  }
  return merged;
}

}  // namespace palpation
