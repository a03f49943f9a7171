#include "geometry/nearest_segment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace palpation {

namespace {

constexpr int kSegmentsPerLeaf = 4;

int boxes_needed(int segments) {
  return segments <= kSegmentsPerLeaf ? 1 : 1 + 2 * boxes_needed((segments + 1) / 2);
}

}  // namespace

template <int dimension>
double Segment<dimension>::nearest_part(const Point& place) const {
  const Point along = to - from;
  const double squared_length = along.squaredNorm();
  return squared_length > 0.0 ? std::clamp((place - from).dot(along) / squared_length, 0.0, 1.0)
                              : 0.0;
}

template <int dimension>
double Segment<dimension>::squared_distance(const Point& place) const {
  return (place - from - nearest_part(place) * (to - from)).squaredNorm();
}

template <int dimension>
NearestSegment<dimension>::NearestSegment(std::vector<Segment<dimension>> segments)
    : segments_(std::move(segments)) {
  const int count = static_cast<int>(segments_.size());
  boxes_.resize(boxes_needed(count));
  build(0, 0, count);
}

template <int dimension>
void NearestSegment<dimension>::build(int node, int first, int last) {
  if (last - first <= kSegmentsPerLeaf) {
    for (int i = first; i < last; ++i)
      boxes_[node].extend(segments_[i].from).extend(segments_[i].to);
    return;
  }
  const int middle = first + (last - first + 1) / 2;
  build(2 * node + 1, first, middle);
  build(2 * node + 2, middle, last);
  boxes_[node] = boxes_[2 * node + 1].merged(boxes_[2 * node + 2]);
}

template <int dimension>
template <typename SquaredDistance>
void NearestSegment<dimension>::search(const Point& place, double shrink,
                                       const SquaredDistance& squared_distance, int node, int first,
                                       int last, double& best, int& nearest) const {
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
  if (left_first && left < best)
    search(place, shrink, squared_distance, 2 * node + 1, first, middle, best, nearest);
  if (right < best)
    search(place, shrink, squared_distance, 2 * node + 2, middle, last, best, nearest);
  if (!left_first && left < best)
    search(place, shrink, squared_distance, 2 * node + 1, first, middle, best, nearest);
}

template <int dimension>
double NearestSegment<dimension>::distance(const Point& place, int& hint) const {
  const auto squared_distance = [&](const Segment<dimension>& segment) {
    return segment.squared_distance(place);
  };
  double best = squared_distance(segments_[hint]);
  search(place, 1.0, squared_distance, 0, 0, static_cast<int>(segments_.size()), best, hint);
  return std::sqrt(best);
}

template <int dimension>
typename NearestSegment<dimension>::Point NearestSegment<dimension>::nearest(const Point& place,
                                                                             const Square& stretch,
                                                                             int& hint) const {
  const auto stretched = [&](const Segment<dimension>& segment) {
    return Segment<dimension>{stretch * (segment.from - place), stretch * (segment.to - place)};
  };
  const auto squared_distance = [&](const Segment<dimension>& segment) {
    return stretched(segment).squared_distance(Point::Zero());
  };
  // The least singular value is no less than this, by the norm of Frobenius; nothing is pruned
  // where the stretch has no inverse.
  const double inverse_norm = stretch.inverse().norm();
  const double least_stretch = std::isfinite(inverse_norm) ? 1.0 / inverse_norm : 0.0;
  double best = squared_distance(segments_[hint]);
  search(place, (1.0 - 1e-9) * least_stretch * least_stretch, squared_distance, 0, 0,
         static_cast<int>(segments_.size()), best, hint);
  const Segment<dimension>& found = segments_[hint];
  const double part = stretched(found).nearest_part(Point::Zero());
  return found.from + part * (found.to - found.from);
}

template struct Segment<2>;
template struct Segment<3>;
template class NearestSegment<2>;
template class NearestSegment<3>;

}  // namespace palpation
