#include "readings/passes.h"

#include <algorithm>

#include "readings/robust.h"

namespace palpation {
namespace {

constexpr double kJump_m = 0.005;
constexpr double kTurn_m = 0.0015;
constexpr double kHeading_m =
    0.003;  // a pass has a heading once it is this long: poses tremble by a tenth of a millimetre

}  // namespace

std::vector<Pass> passes_of(const std::vector<Vec3>& places) {
  std::vector<Pass> passes;
  Vec3 heading = Vec3::Zero();
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    bool ends = passes.empty() || (places[i] - places[i - 1]).norm() > kJump_m;
    if (!ends && !heading.isZero(0.0)) {
      const Vec3 from_start = places[i] - places[passes.back().front()];
      const double along_m = from_start.dot(heading);
      ends = along_m < farthest_m - kTurn_m ||
             (from_start - along_m * heading).norm() > kTurn_m + 0.1 * along_m;
      farthest_m = std::max(farthest_m, along_m);
    }
    if (ends) {
      passes.emplace_back();
      heading.setZero();
      farthest_m = 0.0;
    }
    passes.back().push_back(i);
    const Vec3 way = places[i] - places[passes.back().front()];
    if (heading.isZero(0.0) && way.norm() >= kHeading_m) heading = way.normalized();
  }
  return passes;
}

double median_step_m(const std::vector<Vec3>& places, const Pass& pass) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < pass.size(); ++i)
    steps.push_back((places[pass[i]] - places[pass[i - 1]]).norm());
  return steps.empty() ? 0.0 : median(steps);
}

}  // namespace palpation
