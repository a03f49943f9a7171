#include "geometry/margin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/metric_builder.h"
#include "geometry/notches.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGrowth = 0.3;          // of a ring's distance from the border is its width
constexpr double kCoarsest = 1.0 / 6.0;  // of the margin is the first ring's width at most
constexpr double kFillShare = 1.0 / 16;  // of the margin: edges in what is filled
constexpr double kHoleLeft =
    0.3;  // of its length is left of a border that closes in, where the margin ends

/// A border laid out in the plane, edge after edge, twice around: near each other, places beside it
/// are as far apart as there.
class Development {
 public:
  explicit Development(const BorderLoop& loop) : loop_(loop) {
    Vec2 corner = Vec2::Zero();
    double heading = 0.0;
    for (std::size_t round = 0; round < 2; ++round) {
      for (const Rim& rim : loop) {
        heading += kPi - rim.interior;
        corners_.push_back(corner);
        headings_.push_back(heading);
        corner += rim.length * Vec2(std::cos(heading), std::sin(heading));
      }
    }
  }

  /// Piece 2 i is the wedge before the edge from vertex i, piece 2 i + 1 the strip beside that
  /// edge.
  std::size_t piece_count() const { return 2 * loop_.size(); }

  /// Length of a piece's outer side at a distance from the border.
  double length(std::size_t piece, double distance) const {
    const Rim& rim = loop_[piece / 2];
    if (piece % 2 == 0) return distance * std::max(kPi - rim.interior, 0.0);
    const auto [from, to] = kept(piece / 2, distance);
    return to - from;
  }

  /// Where a part of that side ends.
  Vec2 place(std::size_t piece, double part, double distance) const {
    const std::size_t vertex = piece / 2, here = vertex % loop_.size();
    const double turn = kPi - loop_[here].interior;
    const bool is_wedge = piece % 2 == 0;
    const double heading = headings_[vertex] - (is_wedge && turn > 0.0 ? (1.0 - part) * turn : 0.0);
    const Vec2 along(std::cos(heading), std::sin(heading)), outward(along.y(), -along.x());
    double done = 0.0;
    if (!is_wedge) {
      const auto [from, to] = kept(here, distance);
      done = from + part * (to - from);
    }
    return corners_[vertex] + done * along + distance * outward;
  }

 private:
  /// What the neighbours leave of a strip at a distance, where the border turns inwards.
  std::pair<double, double> kept(std::size_t i, double distance) const {
    const auto lost = [&](const Rim& rim) {
      return rim.interior > kPi ? distance * std::tan(0.5 * std::min(rim.interior - kPi, 0.9 * kPi))
                                : 0.0;
    };
    const double length = loop_[i].length;
    double from = lost(loop_[i]), to = length - lost(loop_[after(loop_, i)]);
    if (to < from) from = to = std::clamp(0.5 * (from + to), 0.0, length);
    return {from, to};
  }

  const BorderLoop& loop_;
  std::vector<Vec2> corners_;
  std::vector<double> headings_;
};

/// A point of a ring: how far around, in pieces, and where in the first and in the second round.
struct RingPoint {
  int vertex;
  double around;
  Vec2 place, place_again;
};

struct Ring {
  std::vector<RingPoint> points;
  std::vector<int> half_edges;  // the border edge from each point to the next
};

Ring first_ring(const BorderLoop& loop, const Development& development) {
  Ring ring;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double around = 2.0 * static_cast<double>(i) + 0.5;
    ring.points.push_back({loop[i].vertex, around, development.place(2 * i, 0.5, 0.0),
                           development.place(2 * i + development.piece_count(), 0.5, 0.0)});
    ring.half_edges.push_back(loop[i].half_edge);
  }
  return ring;
}

double ring_length(const Development& development, double distance) {
  double length = 0.0;
  for (std::size_t piece = 0; piece < development.piece_count(); ++piece)
    length += development.length(piece, distance);
  return length;
}

/// Points evenly along a ring; every second ring half a step on.
Ring next_ring(const Development& development, double distance, double spacing, bool shifted,
               MetricBuilder& builder) {
  const double length = ring_length(development, distance);
  const int count = std::max(3, static_cast<int>(std::lround(length / spacing)));
  Ring ring;
  std::size_t piece = 0;
  double passed = 0.0, here = development.length(0, distance);
  for (int i = 0; i < count; ++i) {
    const double at = (i + (shifted ? 0.75 : 0.25)) * length / count;
    while (piece + 1 < development.piece_count() && passed + here < at) {
      passed += here;
      here = development.length(++piece, distance);
    }
    const double part = here > 0.0 ? std::clamp((at - passed) / here, 0.0, 1.0) : 0.5;
    ring.points.push_back({builder.add_vertex(), static_cast<double>(piece) + part,
                           development.place(piece, part, distance),
                           development.place(piece + development.piece_count(), part, distance)});
  }
  ring.half_edges.resize(ring.points.size());
  return ring;
}

/// A strip of triangles between two rings, from where both start, always on to the point that comes
/// next.
void stitch(Ring& inner, Ring& outer, double period, double target, MetricBuilder& builder) {
  const auto around = [&](const Ring& ring, std::size_t i) {
    return ring.points[i % ring.points.size()].around + (i >= ring.points.size() ? period : 0.0);
  };
  const auto place = [&](const Ring& ring, std::size_t i) {
    return i >= ring.points.size() ? ring.points[i - ring.points.size()].place_again
                                   : ring.points[i].place;
  };
  const auto vertex = [&](const Ring& ring, std::size_t i) {
    return ring.points[i % ring.points.size()].vertex;
  };
  const std::size_t inner_count = inner.points.size(), outer_count = outer.points.size();
  int first_face = -1,
      open_side = -1;  // half-edge from the outer point to the inner one of the face before
  for (std::size_t i = 0, o = 0; i < inner_count || o < outer_count;) {
    const bool along_inner =
        o == outer_count || (i < inner_count && around(inner, i + 1) <= around(outer, o + 1));
    const double across = (place(inner, i) - place(outer, o)).norm();
    const std::size_t i2 = along_inner ? i + 1 : i, o2 = along_inner ? o : o + 1;
    const double across_next = (place(inner, i2) - place(outer, o2)).norm();
    int face = 0, closes = 0, opens = 0;
    if (along_inner) {
      const double length = builder.length(inner.half_edges[i]);
      face = builder.add_face({vertex(inner, i2), vertex(inner, i), vertex(outer, o)},
                              {length, across, across_next}, target);
      builder.glue(3 * face, inner.half_edges[i]);
      closes = 3 * face + 1;
      opens = 3 * face + 2;
    } else {
      const double length = (place(outer, o2) - place(outer, o)).norm();
      face = builder.add_face({vertex(outer, o), vertex(outer, o2), vertex(inner, i)},
                              {length, across_next, across}, target);
      outer.half_edges[o] = 3 * face;
      closes = 3 * face + 2;
      opens = 3 * face + 1;
    }
    if (open_side >= 0)
      builder.glue(closes, open_side);
    else
      first_face = closes;
    open_side = opens;
    i = i2;
    o = o2;
  }
  builder.glue(first_face, open_side);
}

void add_rings(const BorderLoop& loop, double first_width, double width, MetricBuilder& builder) {
  const Development development(loop);
  const double whole = ring_length(development, 0.0);
  Ring inner = first_ring(loop, development);
  const double period = static_cast<double>(development.piece_count());
  bool shifted = false;
  for (double distance = 0.0; distance < (1.0 - 1e-9) * width; shifted = !shifted) {
    double step = std::max(first_width, kGrowth * distance);
    if (distance + 1.5 * step > width) step = width - distance;
    distance += step;
    if (ring_length(development, distance) < kHoleLeft * whole) return;
    Ring outer = next_ring(development, distance, step, shifted, builder);
    stitch(inner, outer, period, step, builder);
    inner = std::move(outer);
  }
}

/// Starts the loop where its edges change most, wherever its vertices' numbers begin: what is built
/// on it then does not depend on those.
void start_at_landmark(BorderLoop& loop) {
  const auto change = [&](std::size_t i) {
    const double a = loop[before(loop, i)].length, b = loop[i].length;
    return (b - a) / (a + b) + 0.1 * (loop[i].interior - kPi);
  };
  constexpr double kRounding = 1e-9;
  std::size_t landmark = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    if (change(i) > change(landmark) + kRounding) landmark = i;
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(landmark), loop.end());
}

/// The border as the mesh has it. `corner_sums`: the angles around each vertex.
BorderLoop loop_of(const MetricMesh& mesh, const std::vector<int>& vertices,
                   const Field& corner_sums, const std::vector<int>& border_from) {
  BorderLoop loop;
  for (const int vertex : vertices) {
    const int half_edge = border_from[vertex];
    loop.push_back(
        {vertex, half_edge, mesh.lengths(half_edge / 3, half_edge % 3), corner_sums[vertex]});
  }
  return loop;
}

}  // namespace

MetricMesh with_margin(const MetricMesh& mesh, const std::vector<std::vector<int>>& border_loops,
                       double width) {
  if (border_loops.empty() || !(width > 0.0)) return mesh;
  Field corner_sums = Field::Zero(mesh.vertex_count);
  std::vector<int> border_from(static_cast<std::size_t>(mesh.vertex_count), -1);
  for (int face = 0; face < mesh.triangles.rows(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      corner_sums[mesh.triangles(face, corner)] += angle_of(mesh, face, corner);
      if (mesh.across(face, corner) < 0)
        border_from[mesh.triangles(face, corner)] = 3 * face + corner;
    }
  }
  MetricBuilder builder(mesh);
  for (const std::vector<int>& vertices : border_loops) {
    BorderLoop loop = loop_of(mesh, vertices, corner_sums, border_from);
    start_at_landmark(loop);
    double perimeter = 0.0;
    for (const Rim& rim : loop) perimeter += rim.length;
    const double first_width =
        std::min(perimeter / static_cast<double>(loop.size()), kCoarsest * width);
    fill_notches(loop, 2.0 * width, std::max(first_width, kFillShare * width), builder);
    if (!loop.empty()) add_rings(loop, first_width, width, builder);
  }
  builder.flip_to_delaunay();
  builder.split_long_edges();
  return builder.done();
}

}  // namespace palpation
