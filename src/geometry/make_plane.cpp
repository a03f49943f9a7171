#include "palpation/geometry/make_plane.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

void check(const PlaneOptions& options) {
  const auto is_length = [](double length) { return std::isfinite(length) && length > 0.0; };
  const std::string size = text_of(options.size_m.x()) + " x " + text_of(options.size_m.y()) + " m";
  require(is_length(options.size_m.x()) && is_length(options.size_m.y()), "make_plane", size,
          "must be positive and finite");
  require(options.corner_m.allFinite(), "make_plane", "corner_m", "must be finite");
  const std::string counts =
      std::to_string(options.columns) + " x " + std::to_string(options.rows) + " vertices";
  require(options.columns >= 2 && options.rows >= 2, "make_plane", counts,
          "must be at least 2 each way");
  const std::int64_t count = static_cast<std::int64_t>(options.columns) * options.rows;
  require(count <= std::int64_t{1} << 27, "make_plane", counts, "must be at most 2^27 in all");
  require(options.jitter >= 0.0 && options.jitter <= 0.45, "make_plane",
          "jitter " + text_of(options.jitter), "must be between 0 and 0.45");
}

/// Place `step` of 0 .. steps on a side, exact at both ends. Jitter moves what is between them.
double along_side(double length, int step, int steps, double jitter, Random& random) {
  double place = step;
  if (jitter > 0.0) {
    const double shift = jitter * (2.0 * random.uniform() - 1.0);
    if (step > 0 && step < steps) place += shift;
  }
  return length * (place / steps);
}

Points place_vertices(const PlaneOptions& options, Random& random) {
  Points vertices(static_cast<Eigen::Index>(options.columns) * options.rows, 3);
  Eigen::Index vertex = 0;
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      const double x =
          along_side(options.size_m.x(), column, options.columns - 1, options.jitter, random);
      const double y =
          along_side(options.size_m.y(), row, options.rows - 1, options.jitter, random);
      vertices.row(vertex++) << options.corner_m.x() + x, options.corner_m.y() + y, 0.0;
    }
  }
  return vertices;
}

bool turns_left(const Points& vertices, int a, int b, int c) {
  const Vec2 ab = (vertices.row(b) - vertices.row(a)).head<2>(),
             ac = (vertices.row(c) - vertices.row(a)).head<2>();
  return ab.x() * ac.y() - ab.y() * ac.x() > 0.0;
}

}  // namespace

TriangleMesh make_plane(const PlaneOptions& options, Random& random) {
  check(options);
  TriangleMesh plane{place_vertices(options, random), {}};
  plane.triangles.resize(2 * static_cast<Eigen::Index>(options.columns - 1) * (options.rows - 1),
                         3);
  Eigen::Index face = 0;
  for (int row = 0; row + 1 < options.rows; ++row) {
    for (int column = 0; column + 1 < options.columns; ++column) {
      const int a = row * options.columns + column, b = a + 1, c = b + options.columns,
                d = a + options.columns;
      // A strongly jittered cell can have a corner that bends inwards: then only the diagonal from
      // that corner is inside the cell.
      const bool rising_fits =
          turns_left(plane.vertices, a, b, c) && turns_left(plane.vertices, a, c, d);
      const bool falling_fits =
          turns_left(plane.vertices, a, b, d) && turns_left(plane.vertices, b, c, d);
      const bool rising = (row + column) % 2 == 0 ? rising_fits : !falling_fits;
      if (rising) {
        plane.triangles.row(face++) << a, b, c;
        plane.triangles.row(face++) << a, c, d;
      } else {
        plane.triangles.row(face++) << a, b, d;
        plane.triangles.row(face++) << b, c, d;
      }
    }
  }
  return plane;
}

}  // namespace palpation
