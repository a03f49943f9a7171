#include "scene/mesh_words.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/mesh_faults.h"
#include "palpation/base/error.h"
#include "scene/surface_remarks.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

// Longer lists help nobody.
constexpr std::size_t kMostListed = 8;
// Laying flat takes two seconds for 80,000 triangles.
constexpr int kMostFacesToFlatten = 200'000;
constexpr double kMisleading = 0.1;

std::string numbered(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// A component or a border, to be listed by size.
struct Part {
  double size = 0.0;
  int count = 0;
  Vec3 sum = Vec3::Zero();
  Vec3 middle() const { return sum / count; }
};

std::string list_words(std::vector<Part> parts, const std::string& each, double scale,
                       const std::string& unit) {
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.size > b.size; });
  std::string words;
  for (std::size_t i = 0; i < std::min(parts.size(), kMostListed); ++i) {
    words += "  " + fixed(parts[i].size * scale, 3) + " " + unit + ", " +
             std::to_string(parts[i].count) + " " + each + ", around " +
             place_words(parts[i].middle(), 2) + "\n";
  }
  if (parts.size() > kMostListed)
    words += "  and " + std::to_string(parts.size() - kMostListed) + " smaller ones\n";
  return words;
}

/// Components by their faces: size is area.
std::vector<Part> components_of(const Surface& surface) {
  std::vector<Part> components;
  std::vector<bool> reached(static_cast<std::size_t>(surface.face_count()), false);
  std::vector<int> waiting;
  for (int first = 0; first < surface.face_count(); ++first) {
    if (reached[static_cast<std::size_t>(first)]) continue;
    Part& component = components.emplace_back();
    reached[static_cast<std::size_t>(first)] = true;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const int face = waiting.back();
      waiting.pop_back();
      component.size += surface.face_area(face);
      component.count += 1;
      component.sum += surface.position({face, Vec3::Constant(1.0 / 3.0)});
      for (int corner = 0; corner < 3; ++corner) {
        const int next = surface.neighbour(face, corner);
        if (next < 0 || reached[static_cast<std::size_t>(next)]) continue;
        reached[static_cast<std::size_t>(next)] = true;
        waiting.push_back(next);
      }
    }
  }
  return components;
}

/// Border loops: size is length.
std::vector<Part> borders_of(const Surface& surface) {
  std::vector<Part> borders;
  for (const std::vector<int>& loop : surface.border_loops()) {
    Part& border = borders.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      border.size += (surface.vertex(loop[(i + 1) % loop.size()]) - surface.vertex(loop[i])).norm();
      border.count += 1;
      border.sum += surface.vertex(loop[i]);
    }
  }
  return borders;
}

std::string topology_words(const Surface& surface) {
  const Topology topology = surface.topology();
  std::string words =
      "Surface: " + numbered(topology.components, "component", "components") + ", " +
      (topology.is_closed() ? "closed" : numbered(topology.borders, "border", "borders")) +
      ", Euler number " + std::to_string(topology.euler) + ", " +
      numbered(topology.handles, "handle", "handles") + "\n";
  if (topology.components > 1)
    words += "Components, the largest first:\n" +
             list_words(components_of(surface), "triangles", 1e4, "cm2");
  if (topology.borders > 1) {
    words += "Borders, the longest first; those that are not the edge of the tissue are holes:\n" +
             list_words(borders_of(surface), "vertices", 1e3, "mm");
  }
  return words;
}

std::string edge_words(const Surface& surface) {
  const EdgeLengths edges = edge_lengths(surface.mesh());
  const std::string coarse = coarse_words(surface);
  return "Edges: " + fixed(edges.shortest_m * 1e3, 3) + " to " + fixed(edges.longest_m * 1e3, 3) +
         " mm, mean " + fixed(edges.mean_m * 1e3, 3) + " mm\n" +
         (coarse.empty() ? "" : coarse + "\n");
}

/// Gaussian curvature at inner vertices, by angle defect over area: its extremes in 1/mm2.
std::pair<double, double> curvature_range(const Surface& surface) {
  Field defect = Field::Constant(surface.vertex_count(), 2.0 * std::numbers::pi);
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i corners = surface.triangle(face);
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 p = surface.vertex(corners[corner]);
      const Vec3 a = surface.vertex(corners[(corner + 1) % 3]) - p;
      const Vec3 b = surface.vertex(corners[(corner + 2) % 3]) - p;
      defect[corners[corner]] -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
  }
  for (const auto& loop : surface.border_loops()) {
    for (int vertex : loop) defect[vertex] = 0.0;
  }
  const Field curvature = defect.array() / surface.vertex_areas().array() * 1e-6;
  return {curvature.minCoeff(), curvature.maxCoeff()};
}

std::string crossing_lines(const Surface& surface) {
  if (!surface.is_planar() && surface.face_count() > kMostFacesToCross)
    return "Self-intersections were not searched for: it has more than " +
           std::to_string(kMostFacesToCross) + " triangles.\n";
  const CrossingWords words = crossing_words(surface);
  if (words.found.empty()) return "";
  return "Warning: " + words.found + "\n  " + words.advice + "\n";
}

const std::string kChoosePart =
    "Next: choose a part to work on by surface.patch (centre_mm and radius_mm, box_mm, or facing) "
    "in a scene; palpate info SCENE.json "
    "looks at it.\n";

std::string disk_advice(const Surface& surface, const std::string& next) {
  if (surface.face_count() > kMostFacesToFlatten)
    return "Curved: a disk, which can be flattened; how well is not tested here, as it has more "
           "than " +
           std::to_string(kMostFacesToFlatten) + " triangles.\n" + next;
  try {
    const Chart& chart = surface.chart();
    if (chart.isometric)
      return "Curved, but it unrolls without stretch: its chart is exact.\nRecommended: "
             "field.metric chart, exact here and the "
             "cheapest.\n" +
             next;
    const std::string warning =
        misleads(chart.distortion)
            ? "Warning: that is more than 10 % off, and field.metric chart would mislead there.\n"
              "Recommended: field.metric intrinsic, whose lengths are those along the surface; or "
              "a smaller part by surface.patch.\n"
            : "Recommended: field.metric chart, less than 10 % off everywhere and the cheapest.\n";
    return "Curved: flattened, it is " + stretch_words(chart.distortion) + ", " +
           fixed(100.0 * chart.distortion.rms_stretch_error, 2) +
           " % off on average; areas and errors are measured on the tissue.\n" + warning + next;
  } catch (const InvalidInput& error) {
    return "Curved, without a chart: " + std::string(error.what()) + ".\n" + kChoosePart;
  }
}

std::string advice(const Surface& surface, const std::string& next) {
  if (surface.is_planar())
    return "Flat: its own plane is its chart, and every metric and the boundary's area are "
           "exact.\nRecommended: field.metric chart, the "
           "cheapest.\n" +
           next;
  if (surface.has_chart()) return disk_advice(surface, next);
  if (surface.topology().is_closed())
    return "Closed: it cannot be flattened as a whole, so it has no chart.\n" + kChoosePart;
  try {
    surface.chart();
  } catch (const InvalidInput& error) {
    return "Without a chart: " + std::string(error.what()) + ".\n" + kChoosePart;
  }
  return kChoosePart;
}

}  // namespace

bool misleads(const Distortion& distortion) {
  return distortion.least_stretch < 1.0 - kMisleading ||
         distortion.greatest_stretch > 1.0 + kMisleading;
}

std::string stretch_words(const Distortion& distortion) {
  return "stretched to between " + fixed(100.0 * distortion.least_stretch, 1) + " and " +
         fixed(100.0 * distortion.greatest_stretch, 1) + " % of its length";
}

std::string size_words(const TriangleMesh& mesh) {
  const Vec3 least = mesh.vertices.colwise().minCoeff(), most = mesh.vertices.colwise().maxCoeff();
  const Vec3 size = (most - least) * 1e3;
  return fixed(size.x(), 2) + " x " + fixed(size.y(), 2) + " x " + fixed(size.z(), 2) +
         " mm, from " + place_words(least, 2) + " to " + place_words(most, 2);
}

std::string surface_words(const Surface& surface, const std::string& next) {
  const auto [least, most] = curvature_range(surface);
  return topology_words(surface) + "Area: " + fixed(surface.area() * 1e4, 3) + " cm2\n" +
         edge_words(surface) + "Gaussian curvature: " + fixed(least, 5) + " to " + fixed(most, 5) +
         " per mm2\n" + crossing_lines(surface) + advice(surface, next);
}

std::string fault_words(const TriangleMesh& mesh, const std::string& reason) {
  std::string words = "Not a surface to plan on: " + reason + "\n";
  const MeshFaults faults = count_faults(mesh);
  const auto say = [&](int count, const std::string& one, const std::string& many,
                       const std::string& meaning) {
    if (count > 0) words += "  " + numbered(count, one, many) + ": " + meaning + "\n";
  };
  say(faults.flat_triangles, "triangle has no area", "triangles have no area",
      "corners on one line or in one place. palpate mesh repair --drop-degenerate (with --weld) "
      "removes them.");
  say(faults.crowded_edges, "edge is in more than two triangles",
      "edges are in more than two triangles",
      "sheets that meet there, or a wall inside the tissue. Delete the triangles that are not its "
      "outside.");
  say(faults.one_way_edges, "edge cannot be faced the same way by its two triangles",
      "edges cannot be faced the same way by their two triangles",
      "the surface has one side only, like a Moebius strip. Delete the triangles where it closes "
      "on itself.");
  say(faults.pinched_vertices, "vertex joins parts that share no edge there",
      "vertices join parts that share no edge there",
      "they touch in a point. Give each part a vertex of its own, or fill the gap with triangles.");
  return words +
         "  (Vertices and triangles are counted from 0 in the order of the file, without unused "
         "ones; places are in metres.)\n";
}

}  // namespace palpation::tool
