#include "boundary/crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace palpation {

namespace {

constexpr int kEdgesPerLeaf = 24;
constexpr int kGreatestDepth = 60;
/// Counting gives up after this many looks at an edge or a pair of edges: a few seconds.
constexpr long kMostWork = 1'000'000'000;

struct Edge {
  Vec2 from;
  Vec2 to;
};

using Box = Eigen::AlignedBox2d;

Vec2 near(const ExactPoint& point) { return {point.approx().x().inf(), point.approx().y().inf()}; }

std::vector<Edge> edges_of(std::span<const ExactRing* const> rings) {
  std::vector<Edge> edges;
  for (const ExactRing* ring : rings) {
    for (std::size_t i = 0; i < ring->size(); ++i) edges.push_back({near((*ring)[i]), near((*ring)[(i + 1) % ring->size()])});
  }
  return edges;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Clips the edge by the four sides in turn (Liang and Barsky 1984).
bool passes(const Edge& edge, const Box& box) {
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double length = edge.to[axis] - edge.from[axis];
    const double to_low = box.min()[axis] - edge.from[axis];
    const double to_high = box.max()[axis] - edge.from[axis];
    if (length == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return false;
      continue;
    }
    first = std::max(first, std::min(to_low / length, to_high / length));
    last = std::min(last, std::max(to_low / length, to_high / length));
  }
  return first <= last;
}

/// In the inside of both edges and in the box, of whose sides only the low ones count: so each crossing is in one box of many side by side.
bool cross_in(const Edge& e, const Edge& f, const Box& box) {
  const Vec2 along_e = e.to - e.from;
  const Vec2 along_f = f.to - f.from;
  const double slant = cross(along_e, along_f);
  const double on_e = cross(f.from - e.from, along_f) / slant;
  const double on_f = cross(f.from - e.from, along_e) / slant;
  if (!(on_e > 0.0 && on_e < 1.0 && on_f > 0.0 && on_f < 1.0)) return false;
  const Vec2 place = e.from + on_e * along_e;
  return (place.array() >= box.min().array()).all() && (place.array() < box.max().array()).all();
}

class Count {
 public:
  Count(const std::vector<Edge>& edges, long limit) : edges_(edges), crossings_left_(limit) {}

  /// Halves the box, across the axis that parts the edges better, until few edges are left. False when the limit is passed.
  bool within(const Box& box, const std::vector<int>& edges, int depth) {
    work_left_ -= static_cast<long>(edges.size());
    if (work_left_ < 0) return false;
    if (edges.size() <= kEdgesPerLeaf || depth == kGreatestDepth) return leaf(box, edges);
    const Halves across_x = halves(box, edges, 0);
    const Halves across_y = halves(box, edges, 1);
    const Halves& better = across_x.size() <= across_y.size() ? across_x : across_y;
    return within(better.low_box, better.low, depth + 1) && within(better.high_box, better.high, depth + 1);
  }

 private:
  struct Halves {
    Box low_box;
    Box high_box;
    std::vector<int> low;
    std::vector<int> high;
    std::size_t size() const { return low.size() + high.size(); }
  };

  Halves halves(const Box& box, const std::vector<int>& edges, int axis) const {
    Halves made{.low_box = box, .high_box = box, .low = {}, .high = {}};
    made.low_box.max()[axis] = made.high_box.min()[axis] = box.center()[axis];
    for (const int edge : edges) {
      if (passes(edges_[edge], made.low_box)) made.low.push_back(edge);
      if (passes(edges_[edge], made.high_box)) made.high.push_back(edge);
    }
    return made;
  }

  bool leaf(const Box& box, const std::vector<int>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      work_left_ -= static_cast<long>(i);
      for (std::size_t j = 0; j < i; ++j) crossings_left_ -= cross_in(edges_[edges[i]], edges_[edges[j]], box) ? 1 : 0;
      if (crossings_left_ < 0 || work_left_ < 0) return false;
    }
    return true;
  }

  const std::vector<Edge>& edges_;
  long crossings_left_;
  long work_left_ = kMostWork;
};

}  // namespace

bool cross_at_most(long limit, std::span<const ExactRing* const> rings) {
  const std::vector<Edge> edges = edges_of(rings);
  const long count = static_cast<long>(edges.size());
  if (count * (count - 1) / 2 <= limit) return true;
  Box box;
  std::vector<int> all;
  for (const Edge& edge : edges) {
    box.extend(edge.from).extend(edge.to);
    all.push_back(static_cast<int>(all.size()));
  }
  return Count(edges, limit).within(box, all, 0);
}

}  // namespace palpation
