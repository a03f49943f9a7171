#include "boundary/tissue_area.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/careful_sum.h"
#include "base/cross.h"
#include "boundary/convex.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kMostColumns = 4096;

/// An edge of a ring from left to right: what is below it counts as the edge's sign says. Summed
/// over all edges, that leaves the inside.
struct Edge {
  Vec2 left, right;
  double sign;
  int first_column, last_column;
};

/// The edges of a region, by columns of the chart: a face looks only at those above and below it.
class Columns {
 public:
  Columns(const Region& region, const Points2& uv, int face_count)
      : left_(uv.col(0).minCoeff()),
        count_(std::clamp(static_cast<int>(2.0 * std::sqrt(face_count)), 1, kMostColumns)),
        width_((uv.col(0).maxCoeff() - left_) / count_),
        edges_(count_) {
    for (const PolygonWithHoles& polygon : region.polygons()) {
      add(polygon.outer);
      for (const Ring& hole : polygon.holes) add(hole);
    }
  }

  /// The area of a triangle inside the region.
  double covered(const Vec2& a, const Vec2& b, const Vec2& c) const {
    const auto [low_x, high_x] = std::minmax({a.x(), b.x(), c.x()});
    const double low_y = std::min({a.y(), b.y(), c.y()});
    const int first = column(low_x), last = column(high_x);
    double sum = 0.0;
    for (int i = first; i <= last; ++i) {
      for (const Edge& edge : edges_[i]) {
        if (i != std::max(first, edge.first_column)) continue;  // seen in an earlier column
        if (edge.right.x() <= low_x || edge.left.x() >= high_x ||
            std::max(edge.left.y(), edge.right.y()) <= low_y)
          continue;
        sum += edge.sign * below(edge, a, b, c);
      }
    }
    return sum;
  }

 private:
  int column(double x) const {
    return static_cast<int>(std::clamp(std::floor((x - left_) / width_), 0.0, count_ - 1.0));
  }

  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &from = ring[i], &to = ring[(i + 1) % ring.size()];
      if (from.x() == to.x()) continue;
      const bool backwards = from.x() > to.x();
      Edge edge{backwards ? to : from, backwards ? from : to, backwards ? 1.0 : -1.0, 0, 0};
      edge.first_column = column(edge.left.x());
      edge.last_column = column(edge.right.x());
      for (int k = edge.first_column; k <= edge.last_column; ++k) edges_[k].push_back(edge);
    }
  }

  /// How much of the triangle is below the edge, between its ends; with coordinates from the
  /// triangle's first corner.
  static double below(const Edge& edge, const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 left = edge.left - a, right = edge.right - a;
    Convex part(Vec2::Zero(), b - a, c - a);
    part.cut([&](const Vec2& p) { return p.x() - left.x(); });
    part.cut([&](const Vec2& p) { return right.x() - p.x(); });
    part.cut([&](const Vec2& p) { return cross(p - left, right - left); });
    return part.area();
  }

  double left_;
  int count_;
  double width_;
  std::vector<std::vector<Edge>> edges_;
};

}  // namespace

double tissue_area(const Surface& surface, const Region& region) {
  if (region.empty()) return 0.0;
  const Points2& uv = surface.chart().uv;
  const Columns columns(region, uv, surface.face_count());
  Field parts(surface.face_count());
  for_ranges(surface.face_count(), 1024, [&](int first, int last) {
    for (int face = first; face < last; ++face) {
      const Eigen::Vector3i t = surface.triangle(face);
      const Vec2 a = uv.row(t[0]), b = uv.row(t[1]), c = uv.row(t[2]);
      parts[face] =
          columns.covered(a, b, c) / (0.5 * cross(b - a, c - a)) * surface.face_area(face);
    }
  });
  CarefulSum sum;
  for (const double part : parts) sum.add(part);
  return sum.value();
}

}  // namespace palpation
