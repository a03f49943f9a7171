#include "boundary/erosion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// The vertices that share an edge with each.
std::vector<std::vector<int>> neighbours(const Surface& surface) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(surface.vertex_count()));
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    for (int i = 0; i < 3; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 3];
      // Each edge once: from the face on its one side, or the lower of two.
      if (const int other = surface.neighbour(face, i); other >= 0 && other < face) continue;
      around[a].push_back(b);
      around[b].push_back(a);
    }
  }
  return around;
}

/// How far along the edge from a place inside the ball around `centre` to one outside its sphere is
/// crossed, in [0, 1].
double crossing(const Vec3& centre, const Vec3& inside, const Vec3& outside, double radius_m) {
  const Vec3 start = inside - centre, way = outside - inside;
  const double a = way.squaredNorm(), b = start.dot(way),
               c = start.squaredNorm() - radius_m * radius_m;
  return std::clamp((std::sqrt(std::max(0.0, b * b - a * c)) - b) / a, 0.0, 1.0);
}

}  // namespace

Eroded eroded(const Surface& surface, const Field& field, double radius_m) {
  require(std::isfinite(radius_m) && radius_m >= 0.0, "eroded", "radius_m = " + text_of(radius_m),
          "must be finite and not negative");
  require(field.size() == surface.vertex_count(), "eroded",
          "a field of " + std::to_string(field.size()) + " values", "must have one per vertex");
  Eroded result{field, std::vector<int>(static_cast<std::size_t>(surface.vertex_count()))};
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) result.from[vertex] = vertex;
  if (radius_m == 0.0) return result;
  const std::vector<std::vector<int>> around = neighbours(surface);
  for_ranges(surface.vertex_count(), 256, [&](int first, int last) {
    std::vector<int> seen(static_cast<std::size_t>(surface.vertex_count()), -1);  // by which centre
    std::vector<int> reached;
    for (int centre = first; centre < last; ++centre) {
      const Vec3 middle = surface.vertex(centre);
      const auto take = [&](double value, int vertex) {
        if (!(value < result.field[centre])) return;
        result.field[centre] = value;
        result.from[centre] = vertex;
      };
      reached.assign(1, centre);
      seen[centre] = centre;
      for (std::size_t i = 0; i < reached.size(); ++i) {
        const int inside = reached[i];
        take(field[inside], inside);
        for (int next : around[inside]) {
          if (seen[next] == centre) continue;
          if ((surface.vertex(next) - middle).norm() > radius_m) {
            const double share =
                crossing(middle, surface.vertex(inside), surface.vertex(next), radius_m);
            take(std::lerp(field[inside], field[next], share), share < 0.5 ? inside : next);
            continue;
          }
          seen[next] = centre;
          reached.push_back(next);
        }
      }
    }
  });
  return result;
}

}  // namespace palpation
