#include "scene/surface_remarks.h"

#include <algorithm>
#include <cmath>

#include "geometry/self_intersection.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

// What a probe resolves.
constexpr double kCoarse_m = 0.001;

}  // namespace

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  EdgeLengths edges{.shortest_m = HUGE_VAL};
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const double length_m = (mesh.vertices.row(mesh.triangles(face, corner)) -
                               mesh.vertices.row(mesh.triangles(face, (corner + 1) % 3)))
                                  .norm();
      edges.shortest_m = std::min(edges.shortest_m, length_m);
      edges.longest_m = std::max(edges.longest_m, length_m);
      edges.mean_m += length_m / (3.0 * static_cast<double>(mesh.triangles.rows()));
    }
  }
  return edges;
}

std::string coarse_words(const Surface& surface) {
  const double longest_m = edge_lengths(surface.mesh()).longest_m;
  if (longest_m <= kCoarse_m) return "";
  return "Coarse: edges up to " + fixed(longest_m * 1e3, 2) +
         " mm exceed what a probe resolves (about 0.5 mm); set surface.refine_mm.";
}

CrossingWords crossing_words(const Surface& surface) {
  if (surface.is_planar() || surface.face_count() > kMostFacesToCross) return {};
  const SelfIntersections found = self_intersections(surface);
  if (!found.complete)
    return {
        "so many triangles lie close together that the search for self-intersections was given up.",
        "Simplify or remesh it."};
  if (found.pairs == 0) return {};
  const auto [a, b] = *found.first;
  const Vec3 place = surface.position({a, Vec3::Constant(1.0 / 3.0)});
  return {"it self-intersects: " + counted(static_cast<std::size_t>(found.pairs), "pair") +
              " of triangles meet, such as triangles " + std::to_string(a) + " and " +
              std::to_string(b) + " around " + place_words(place, 2) + ".",
          "Tissue cannot. Delete one of the sheets, or work on a patch away from it."};
}

std::vector<std::string> surface_remarks(const Surface& surface) {
  std::vector<std::string> remarks;
  if (std::string coarse = coarse_words(surface); !coarse.empty())
    remarks.push_back(std::move(coarse));
  if (const CrossingWords crossing = crossing_words(surface); !crossing.found.empty())
    remarks.push_back("The tissue: " + crossing.found + " " + crossing.advice);
  return remarks;
}

}  // namespace palpation::tool
