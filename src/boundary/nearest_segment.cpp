#include "boundary/nearest_segment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace palpation {

namespace {

constexpr int kSegmentsPerLeaf = 4;

int boxes_needed(int segments) { return segments <= kSegmentsPerLeaf ? 1 : 1 + 2 * boxes_needed((segments + 1) / 2); }

}  // namespace

double Segment::nearest_part(const Vec2& place) const {
  const Vec2 along = to - from;
  const double squared_length = along.squaredNorm();
  return squared_length > 0.0 ? std::clamp((place - from).dot(along) / squared_length, 0.0, 1.0) : 0.0;
}

double Segment::squared_distance(const Vec2& place) const { return (place - from - nearest_part(place) * (to - from)).squaredNorm(); }

NearestSegment::NearestSegment(std::vector<Segment> segments) : segments_(std::move(segments)) {
  const int count = static_cast<int>(segments_.size());
  boxes_.resize(boxes_needed(count));
  build(0, 0, count);
}

void NearestSegment::build(int node, int first, int last) {
  if (last - first <= kSegmentsPerLeaf) {
    for (int i = first; i < last; ++i) boxes_[node].extend(segments_[i].from).extend(segments_[i].to);
    return;
  }
  const int middle = first + (last - first + 1) / 2;
  build(2 * node + 1, first, middle);
  build(2 * node + 2, middle, last);
  boxes_[node] = boxes_[2 * node + 1].merged(boxes_[2 * node + 2]);
}

template <typename SquaredDistance>
void NearestSegment::search(const Vec2& place, double shrink, const SquaredDistance& squared_distance, int node, int first, int last,
                            double& best, int& nearest) const {
  if (last - first <= kSegmentsPerLeaf) {
    for (int i = first; i < last; ++i) {
      const double distance = squared_distance(segments_[i]);
      if (distance >= best) continue;
      best = distance;
      nearest = i;
    }
    return;
  }
  const int middle = first + (last - first + 1) / 2;
  const double left = shrink * boxes_[2 * node + 1].squaredExteriorDistance(place);
  const double right = shrink * boxes_[2 * node + 2].squaredExteriorDistance(place);
  const bool left_first = left <= right;
  if (left_first && left < best) search(place, shrink, squared_distance, 2 * node + 1, first, middle, best, nearest);
  if (right < best) search(place, shrink, squared_distance, 2 * node + 2, middle, last, best, nearest);
  if (!left_first && left < best) search(place, shrink, squared_distance, 2 * node + 1, first, middle, best, nearest);
}

double NearestSegment::distance(const Vec2& place, int& hint) const {
  const auto squared_distance = [&](const Segment& segment) { return segment.squared_distance(place); };
  double best = squared_distance(segments_[hint]);
  search(place, 1.0, squared_distance, 0, 0, static_cast<int>(segments_.size()), best, hint);
  return std::sqrt(best);
}

Vec2 NearestSegment::nearest(const Vec2& place, const Eigen::Matrix2d& stretch, int& hint) const {
  const auto stretched = [&](const Segment& segment) { return Segment{stretch * (segment.from - place), stretch * (segment.to - place)}; };
  const auto squared_distance = [&](const Segment& segment) { return stretched(segment).squared_distance(Vec2::Zero()); };
  // The least singular value, squared, from the sum and the product of both.
  const double half_sum = 0.5 * stretch.squaredNorm(), product = stretch.determinant();
  const double shrink = std::max(0.0, half_sum - std::sqrt(std::max(0.0, half_sum * half_sum - product * product)));
  double best = squared_distance(segments_[hint]);
  search(place, (1.0 - 1e-9) * shrink, squared_distance, 0, 0, static_cast<int>(segments_.size()), best, hint);
  const Segment& found = segments_[hint];
  const double part = stretched(found).nearest_part(Vec2::Zero());
  return found.from + part * (found.to - found.from);
}

}  // namespace palpation
