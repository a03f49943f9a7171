#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "palpation/exploration/reach.h"
#include "palpation/exploration/waypoint.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/places_on.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

Eigen::Matrix4d transform_of(const py::object& given) {
  if (given.is_none()) return Eigen::Matrix4d::Identity();
  const Argument argument{"waypoints", "from_tissue"};
  const Eigen::VectorXd rows =
      numbers_of(py::module_::import("numpy").attr("ravel")(given), argument, 16);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data());
}

template <typename Get>
py::array rows_of(const std::vector<Waypoint>& all, const Get& get) {
  Points rows(static_cast<Eigen::Index>(all.size()), 3);
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    rows.row(row) = get(all[static_cast<std::size_t>(row)]).transpose();
  return array_of(rows);
}

py::array quaternions_of(const std::vector<Waypoint>& all) {
  py::array_t<double> rows({static_cast<py::ssize_t>(all.size()), py::ssize_t{4}});
  for (std::size_t row = 0; row < all.size(); ++row) {
    const Eigen::Vector4d turn = quaternion(all[row].rotation);
    for (py::ssize_t i = 0; i < 4; ++i)
      rows.mutable_at(static_cast<py::ssize_t>(row), i) = turn[static_cast<Eigen::Index>(i)];
  }
  return rows;
}

py::dict poses(const Surface& surface, py::handle where, const py::object& from_tissue,
               double standoff_m, double indent_m, double spring_n_per_m) {
  const std::vector<SurfacePoint> targets = places_on(surface, where, {"waypoints", "where"});
  const Robot robot{transform_of(from_tissue), standoff_m, indent_m, spring_n_per_m};
  const std::vector<Waypoint> all = long_call([&] { return waypoints(surface, targets, robot); });
  Eigen::VectorXd forces(static_cast<Eigen::Index>(all.size()));
  for (Eigen::Index row = 0; row < forces.size(); ++row)
    forces[row] = all[static_cast<std::size_t>(row)].expected_force_n;
  return py::dict("position"_a = rows_of(all, [](const Waypoint& one) { return one.position; }),
                  "normal"_a = rows_of(all, [](const Waypoint& one) { return one.normal; }),
                  "approach"_a = rows_of(all, [](const Waypoint& one) { return one.approach; }),
                  "indented"_a = rows_of(all, [](const Waypoint& one) { return one.indented; }),
                  "quaternion"_a = quaternions_of(all), "expected_force_n"_a = array_of(forces));
}

py::array reachable(const Surface& surface, const py::object& shaft_direction, double cone_deg,
                    double clearance_m, double probe_radius_m) {
  Access access{.cone_rad = cone_deg * std::numbers::pi / 180.0,
                .clearance_m = clearance_m,
                .probe_radius_m = probe_radius_m};
  if (!shaft_direction.is_none())
    access.shaft_direction = vector_of(shaft_direction, {"reachable_vertices", "shaft_direction"});
  return array_of(long_call([&] { return reachable_vertices(surface, access); }));
}

}  // namespace

void bind_robot(py::module_& module) {
  module.def(
      "waypoints", &poses, "surface"_a, "where"_a, py::kw_only(), "from_tissue"_a = py::none(),
      "standoff_m"_a = 0.005, "indent_m"_a = 0.002, "spring_n_per_m"_a = 80.0,
      "Poses for the robot at vertices or positions, in its frame: a dictionary of position, "
      "normal, approach and indented (n x 3, metres), quaternion (n x 4: x, y, z, w; the "
      "probe's z points into the tissue) and expected_force_n. from_tissue: 4 x 4, rigid.");
  module.def("reachable_vertices", &reachable, "surface"_a, py::kw_only(),
             "shaft_direction"_a = py::none(), "cone_deg"_a = 60.0, "clearance_m"_a = 0.0,
             "probe_radius_m"_a = 0.0,
             "The vertices that a probe on a shaft can touch: for Exploration(reach=...).");
}

}  // namespace palpation::python
