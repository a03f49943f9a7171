#include "boundary/nearest_segment.h"

#include <algorithm>
#include <cmath>

namespace palpation {

namespace {

constexpr int kSegmentsPerLeaf = 4;

int boxes_needed(int segments) { return segments <= kSegmentsPerLeaf ? 1 : 1 + 2 * boxes_needed((segments + 1) / 2); }

}  // namespace

double Segment::squared_distance(const Vec2& place) const {
  const Vec2 along = to - from;
  const double squared_length = along.squaredNorm();
  const double part = squared_length > 0.0 ? std::clamp((place - from).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (place - from - part * along).squaredNorm();
}

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

void NearestSegment::search(const Vec2& place, int node, int first, int last, double& best, int& nearest) const {
  if (last - first <= kSegmentsPerLeaf) {
    for (int i = first; i < last; ++i) {
      const double distance = segments_[i].squared_distance(place);
      if (distance >= best) continue;
      best = distance;
      nearest = i;
    }
    return;
  }
  const int middle = first + (last - first + 1) / 2;
  const double left = boxes_[2 * node + 1].squaredExteriorDistance(place);
  const double right = boxes_[2 * node + 2].squaredExteriorDistance(place);
  const bool left_first = left <= right;
  if (left_first && left < best) search(place, 2 * node + 1, first, middle, best, nearest);
  if (right < best) search(place, 2 * node + 2, middle, last, best, nearest);
  if (!left_first && left < best) search(place, 2 * node + 1, first, middle, best, nearest);
}

double NearestSegment::distance(const Vec2& place, int& hint) const {
  double best = segments_[hint].squared_distance(place);
  search(place, 0, 0, static_cast<int>(segments_.size()), best, hint);
  return std::sqrt(best);
}

}  // namespace palpation
