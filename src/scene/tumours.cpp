#include "scene/tumours.h"

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "palpation/base/contract.h"
#include "scene/scene_json.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kFarthest_m = 0.005;

Vec3 point_of(const json& mm) {
  return Vec3(Vec3(mm[0].get<double>(), mm[1].get<double>(), mm[2].get<double>()) / 1000.0);
}

Tumour tumour_of(const json& shape) {
  if (shape["shape"] == "disk")
    return Disk{point_of(shape["centre_mm"]), shape["radius_mm"].get<double>() / 1000.0};
  if (shape["shape"] == "horseshoe") {
    Horseshoe horseshoe{point_of(shape["centre_mm"]), shape["arc_radius_mm"].get<double>() / 1000.0,
                        shape["half_width_mm"].get<double>() / 1000.0};
    horseshoe.arc_rad = shape.value("arc_deg", 180.0) * std::numbers::pi / 180.0;
    if (shape.contains("facing")) horseshoe.facing = 1000.0 * point_of(shape["facing"]);
    return horseshoe;
  }
  Outline outline;
  for (const json& corner : shape["points_mm"]) outline.points_m.push_back(point_of(corner));
  return outline;
}

/// What is wrong with a tumour, and of what it is wrong; nothing where it is sound.
struct TumourFault {
  std::string of, words;
};

std::optional<TumourFault> tumour_fault(const Surface& surface, const Tumour& tumour) {
  try {
    signed_distance(surface, std::span(&tumour, 1));
    return std::nullopt;
  } catch (const BrokenContract& error) {
    constexpr std::string_view kFirst = "tumour 1: ";  // of a list of one
    std::string of = error.value();
    if (of.starts_with(kFirst)) of.erase(0, kFirst.size());
    return TumourFault{of, of + " " + error.rule()};
  }
}

/// The point lies on the tissue, or the scene is refused.
void check_place(const Scene& scene, const Surface& surface, const std::string& path,
                 const json& mm) {
  const Vec3 position = point_of(mm);
  const double distance = (surface.position(surface.project(position)) - position).norm();
  if (distance <= kFarthest_m) return;
  const Vec3 least = surface.mesh().vertices.colwise().minCoeff() * 1000.0,
             most = surface.mesh().vertices.colwise().maxCoeff() * 1000.0;
  const auto corner = [](const Vec3& point) {
    return "[" + text_of(point.x()) + ", " + text_of(point.y()) + ", " + text_of(point.z()) + "]";
  };
  scene.refuse(path, "is " + shown(mm) + ", which lies " + fixed(distance * 1000.0, 1) +
                         " mm off the tissue; it may be at most 5 mm off. The tissue spans " +
                         corner(least) + " to " + corner(most) + " mm");
}

[[noreturn]] void refuse_tumour(const Scene& scene, const Surface& surface, const std::string& path,
                                const json& shape, const TumourFault& fault) {
  if (shape.contains("centre_mm"))
    check_place(scene, surface, path + ".centre_mm", shape["centre_mm"]);
  if (shape["shape"] == "polygon") {
    if (!surface.has_chart())
      scene.refuse(path, "a polygon needs tissue that can be flattened: a patch without holes");
    const json& points = shape["points_mm"];
    for (std::size_t i = 0; i < points.size(); ++i)
      check_place(scene, surface, path + ".points_mm[" + std::to_string(i) + "]", points[i]);
    scene.refuse(path + ".points_mm", "is " + fault.words);
  }
  if (shape["shape"] == "horseshoe" && fault.of == "facing")
    scene.refuse(path + ".facing", "must have a part along the surface");
  if (shape["shape"] == "horseshoe" && fault.of.starts_with("arc radius"))
    scene.refuse(path + ".arc_radius_mm", "is " + shown(shape["arc_radius_mm"]) +
                                              ", but must not exceed the tissue's size, " +
                                              fixed(surface.diameter() * 1000.0, 1) + " mm");
  scene.refuse(path, fault.words);
}

}  // namespace

std::vector<Tumour> tumours_of(const Scene& scene) {
  std::vector<Tumour> tumours;
  for (const json& shape : scene.tumours()) tumours.push_back(tumour_of(shape));
  return tumours;
}

void refuse_tumours(const Scene& scene, const Surface& surface,
                    const std::vector<Tumour>& tumours) {
  for (std::size_t i = 0; i < tumours.size(); ++i) {
    if (const auto fault = tumour_fault(surface, tumours[i]))
      refuse_tumour(scene, surface, "probe.tumours[" + std::to_string(i) + "]", scene.tumours()[i],
                    *fault);
  }
}

}  // namespace palpation::tool
