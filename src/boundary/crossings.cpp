#include "boundary/crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/cross.h"

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

bool is_lower(const Vec2& a, const Vec2& b) {
  return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
}

/// From the lower end (x before y) to the higher. Edges that are equal count as one: they are
/// merged before the overlay is made.
std::vector<Edge> edges_of(std::span<const ExactRing* const> rings) {
  std::vector<Edge> edges;
  for (const ExactRing* ring : rings) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const Vec2 a = near((*ring)[i]);
      const Vec2 b = near((*ring)[(i + 1) % ring->size()]);
      edges.push_back(is_lower(a, b) ? Edge{a, b} : Edge{b, a});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
    return e.from == f.from ? is_lower(e.to, f.to) : is_lower(e.from, f.from);
  });
  edges.erase(
      std::unique(edges.begin(), edges.end(),
                  [](const Edge& e, const Edge& f) { return e.from == f.from && e.to == f.to; }),
      edges.end());
  return edges;
}

/// Pairs of edges that meet at one point, where more than a hundred do: the time that an overlay
/// takes grows with their number.
long crowded_pairs(const std::vector<Edge>& edges) {
  constexpr long kCrowd = 100;
  std::vector<Vec2> ends;
  ends.reserve(2 * edges.size());
  for (const Edge& edge : edges) ends.insert(ends.end(), {edge.from, edge.to});
  std::sort(ends.begin(), ends.end(), is_lower);
  long pairs = 0;
  for (auto first = ends.begin(); first != ends.end();) {
    const auto last =
        std::find_if(first, ends.end(), [&](const Vec2& end) { return end != *first; });
    const long crowd = last - first;
    if (crowd > kCrowd) pairs += crowd * (crowd - 1) / 2;
    first = last;
  }
  return pairs;
}

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

/// Of the box' sides only the low ones count: so each place is in one box of many side by side.
bool is_in(const Box& box, const Vec2& place) {
  return (place.array() >= box.min().array()).all() && (place.array() < box.max().array()).all();
}

/// In the inside of both edges and in the box.
bool cross_in(const Edge& e, const Edge& f, const Box& box) {
  const Vec2 along_e = e.to - e.from;
  const Vec2 along_f = f.to - f.from;
  const double slant = cross(along_e, along_f);
  const double on_e = cross(f.from - e.from, along_f) / slant;
  const double on_f = cross(f.from - e.from, along_e) / slant;
  return on_e > 0.0 && on_e < 1.0 && on_f > 0.0 && on_f < 1.0 &&
         is_in(box, e.from + on_e * along_e);
}

/// Whether the edges run along one line, to rounding, and share a part of it that begins in the
/// box.
bool overlap_in(const Edge& e, const Edge& f, const Box& box, double rounding) {
  const Vec2 along = e.to - e.from;
  const double reach = rounding * along.lpNorm<1>();
  if (std::abs(cross(along, f.from - e.from)) > reach ||
      std::abs(cross(along, f.to - e.from)) > reach)
    return false;
  const Vec2& first = is_lower(e.from, f.from) ? f.from : e.from;
  const Vec2& last = is_lower(e.to, f.to) ? e.to : f.to;
  return is_lower(first, last) && is_in(box, first);
}

class Count {
 public:
  Count(const std::vector<Edge>& edges, double rounding, long limit)
      : edges_(edges), rounding_(rounding), crossings_left_(limit) {}

  /// Halves the box, across the axis that leaves fewer pairs, until few edges are left. False when
  /// the limit is passed.
  bool within(const Box& box, const std::vector<int>& edges, int depth) {
    work_left_ -= static_cast<long>(edges.size());
    if (work_left_ < 0) return false;
    if (edges.size() <= kEdgesPerLeaf || depth == kGreatestDepth) return leaf(box, edges);
    const Halves across_x = halves(box, edges, 0);
    const Halves across_y = halves(box, edges, 1);
    const Halves& better = across_x.pairs() <= across_y.pairs() ? across_x : across_y;
    return within(better.low_box, better.low, depth + 1) &&
           within(better.high_box, better.high, depth + 1);
  }

 private:
  struct Halves {
    Box low_box;
    Box high_box;
    std::vector<int> low;
    std::vector<int> high;
    std::size_t pairs() const { return low.size() * low.size() + high.size() * high.size(); }
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
      for (std::size_t j = 0; j < i; ++j) {
        const Edge& e = edges_[edges[i]];
        const Edge& f = edges_[edges[j]];
        if (cross_in(e, f, box) || overlap_in(e, f, box, rounding_)) --crossings_left_;
      }
      if (crossings_left_ < 0 || work_left_ < 0) return false;
    }
    return true;
  }

  const std::vector<Edge>& edges_;
  double rounding_;  ///< of coordinates
  long crossings_left_;
  long work_left_ = kMostWork;
};

}  // namespace

bool cross_at_most(long limit, std::span<const ExactRing* const> rings) {
  const std::vector<Edge> edges = edges_of(rings);
  const long count = static_cast<long>(edges.size());
  if (count * (count - 1) / 2 <= limit) return true;
  limit -= crowded_pairs(edges);
  if (limit < 0) return false;
  Box box;
  std::vector<int> all;
  for (const Edge& edge : edges) {
    box.extend(edge.from).extend(edge.to);
    all.push_back(static_cast<int>(all.size()));
  }
  // Highest corners are in the box too.
  const double greatest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * greatest;
  box.max().array() += rounding;
  return Count(edges, rounding, limit).within(box, all, 0);
}

}  // namespace palpation
