#include "palpation/geometry/make_phantom.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kMostVertices = 134'217'728.0;  // 2^27

/// A number in [-jitter, jitter].
double shift(double jitter, Random& random) { return jitter * (2.0 * random.uniform() - 1.0); }

class Mesher {
 public:
  Mesher(const Sheet& sheet, double jitter, Random& random)
      : sheet_(sheet), jitter_(jitter), random_(random) {}

  PhantomMesh rectangle(int columns, int rows) {
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column <= columns; ++column) {
        const double s = along_side(column, columns), t = along_side(row, rows);
        add(sheet_.corner_m + Vec2(s, t).cwiseProduct(sheet_.size_m));
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int a = row * (columns + 1) + column, b = a + 1, d = a + columns + 1, c = d + 1;
        if (rising_is_better(a, b, c, d)) {
          triangles_.insert(triangles_.end(), {{a, b, c}, {a, c, d}});
        } else {
          triangles_.insert(triangles_.end(), {{a, b, d}, {b, c, d}});
        }
      }
    }
    return finished();
  }

  /// Ring k has 6 k vertices, and starts anywhere.
  PhantomMesh disk(int rings) {
    const Vec2 middle = sheet_.corner_m + 0.5 * sheet_.size_m;
    const double reach = 0.5 * sheet_.size_m.x();
    add(middle);
    std::vector<double> inner, outer;  // angles of a ring, rising over one turn
    for (int ring = 1; ring <= rings; ++ring) {
      outer.clear();
      const int count = 6 * ring;
      const double start = random_.uniform();
      for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + start + shift(jitter_, random_)) / count;
        const double out = ring < rings ? ring + 0.5 * shift(jitter_, random_) : rings;
        outer.push_back(angle);
        add(middle + out / rings * reach * Vec2(std::cos(angle), std::sin(angle)));
      }
      join_rings(inner, outer);
      inner = outer;
    }
    return finished();
  }

 private:
  double along_side(int step, int steps) {
    const double moved =
        shift(jitter_, random_);  // drawn for ends too, so that all vertices draw alike
    return (step > 0 && step < steps ? step + moved : step) / steps;
  }

  void add(const Vec2& parameters) {
    parameters_.push_back(parameters);
    vertices_.push_back(sheet_.position(parameters));
  }

  bool turns_left(int a, int b, int c) const {
    const Vec2 ab = parameters_[b] - parameters_[a], ac = parameters_[c] - parameters_[a];
    return ab.x() * ac.y() - ab.y() * ac.x() > 0.0;
  }

  double angle_at(int corner, int a, int b) const {
    const Vec3 to_a = vertices_[a] - vertices_[corner], to_b = vertices_[b] - vertices_[corner];
    return std::atan2(to_a.cross(to_b).norm(), to_a.dot(to_b));
  }

  /// Delaunay's rule in space, where both diagonals lie inside the cell; a coin where they are
  /// equal.
  bool rising_is_better(int a, int b, int c, int d) {
    const bool coin = random_.uniform() < 0.5;
    if (!turns_left(a, b, c) || !turns_left(a, c, d)) return false;
    if (!turns_left(a, b, d) || !turns_left(b, c, d)) return true;
    const double beside_rising = angle_at(b, a, c) + angle_at(d, a, c),
                 beside_falling = angle_at(a, b, d) + angle_at(c, b, d);
    constexpr double kEqual = 1e-9;  // radians
    if (std::abs(beside_rising - beside_falling) < kEqual) return coin;
    return beside_rising < beside_falling;
  }

  /// Triangles between the two last rings, in the order of their corners' angles. An empty inner
  /// ring is the middle.
  void join_rings(const std::vector<double>& inner, const std::vector<double>& outer) {
    const int outer_count = static_cast<int>(outer.size()),
              inner_count = static_cast<int>(inner.size());
    const int first_outer = static_cast<int>(vertices_.size()) - outer_count;
    if (inner.empty()) {
      for (int k = 0; k < outer_count; ++k)
        triangles_.push_back({0, first_outer + k, first_outer + (k + 1) % outer_count});
      return;
    }
    const int first_inner = first_outer - inner_count;
    const double turn = 2.0 * std::numbers::pi;
    const auto angle = [turn](const std::vector<double>& ring, int k) {
      const int count = static_cast<int>(ring.size());
      return ring[k % count] + turn * (k / count);
    };
    // The triangle that starts the walk: the inner ring's first vertex, and the outer one's last
    // before it in angle.
    int i = 0, o = 0;
    while (angle(outer, o + 1) <= inner.front() + turn) ++o;
    const auto inner_angle = [&](int k) { return angle(inner, k) + turn; };
    const int last_o = o + outer_count;
    while (i < inner_count || o < last_o) {
      const int at_inner = first_inner + i % inner_count, at_outer = first_outer + o % outer_count;
      const bool outwards =
          i == inner_count || (o < last_o && angle(outer, o + 1) <= inner_angle(i + 1));
      if (outwards) {
        ++o;
        triangles_.push_back({at_inner, at_outer, first_outer + o % outer_count});
      } else {
        ++i;
        triangles_.push_back({at_inner, at_outer, first_inner + i % inner_count});
      }
    }
  }

  PhantomMesh finished() const {
    PhantomMesh result;
    const auto count = static_cast<Eigen::Index>(vertices_.size());
    result.mesh.vertices.resize(count, 3);
    result.parameters.resize(count, 2);
    for (Eigen::Index v = 0; v < count; ++v) {
      result.mesh.vertices.row(v) = vertices_[v];
      result.parameters.row(v) = parameters_[v];
    }
    result.mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (Eigen::Index f = 0; f < result.mesh.triangles.rows(); ++f)
      result.mesh.triangles.row(f) = triangles_[f].transpose();
    return result;
  }

  const Sheet& sheet_;
  double jitter_;
  Random& random_;
  std::vector<Vec2> parameters_;
  std::vector<Vec3> vertices_;
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace

PhantomMesh make_phantom(const Sheet& sheet, double edge_m, double jitter, Random& random) {
  require(std::isfinite(edge_m) && edge_m > 0.0, "make_phantom", "edge_m = " + text_of(edge_m),
          "must be positive and finite");
  require(jitter >= 0.0 && jitter <= 0.45, "make_phantom", "jitter = " + text_of(jitter),
          "must be between 0 and 0.45");
  const Vec2 cells = (sheet.size_m / edge_m).array().round().cwiseMax(1.0);
  require((cells.x() + 1.0) * (cells.y() + 1.0) <= kMostVertices, "make_phantom",
          "edge_m = " + text_of(edge_m), "must leave at most 2^27 vertices");
  Mesher mesher(sheet, jitter, random);
  if (!sheet.is_round)
    return mesher.rectangle(static_cast<int>(cells.x()), static_cast<int>(cells.y()));
  return mesher.disk(static_cast<int>(std::max(1.0, std::round(0.5 * cells.x()))));
}

}  // namespace palpation
