#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/boundary/level_set.h"
#include "palpation/world/phantom.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/exclusive.h"
#include "python/long_call.h"
#include "python/places_on.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

struct Simulated {
  Surface surface;
  Phantom phantom;
};

using Stream = Exclusive<Random>;

std::vector<Vec3> rows_of(const Points& points) {
  std::vector<Vec3> rows;
  for (Eigen::Index row = 0; row < points.rows(); ++row)
    rows.emplace_back(points.row(row).transpose());
  return rows;
}

Simulated phantom_of(const Surface& surface, std::vector<Tumour> tumours, StiffnessModel model,
                     const py::object& bias_axis) {
  if (!bias_axis.is_none()) model.bias_axis = vector_of(bias_axis, {"Phantom", "bias_axis"});
  return long_call([&] { return Simulated{surface, Phantom(surface, std::move(tumours), model)}; });
}

py::array touched(const Simulated& world, py::handle where, Stream& stream,
                  const py::object& travel) {
  const std::vector<SurfacePoint> places =
      places_on(world.surface, where, {"Phantom.touch", "where"});
  Points directions = Points::Zero(static_cast<Eigen::Index>(places.size()), 3);
  if (!travel.is_none()) directions = points_of(travel, {"Phantom.touch", "travel"});
  require(directions.rows() == static_cast<Eigen::Index>(places.size()), "Phantom.touch",
          "travel of " + std::to_string(directions.rows()) + " rows",
          "must have one for each place");
  const auto random = stream.take("Random");
  return array_of(long_call([&] {
    Eigen::VectorXd readings(directions.rows());
    for (Eigen::Index row = 0; row < readings.size(); ++row)
      readings[row] = world.phantom
                          .touch(places[static_cast<std::size_t>(row)],
                                 directions.row(row).transpose(), *random)
                          .reading;
    return readings;
  }));
}

void bind_tumours(py::module_& module) {
  py::class_<Disk>(module, "Disk", "All places within a radius of a centre, along the surface.")
      .def(py::init([](py::handle centre_m, double radius_m) {
             return Disk{vector_of(centre_m, {"Disk", "centre_m"}), radius_m};
           }),
           "centre_m"_a, "radius_m"_a);
  py::class_<Horseshoe>(module, "Horseshoe",
                        "All places within half_width_m of an arc of a circle.")
      .def(py::init([](py::handle centre_m, double arc_radius_m, double half_width_m,
                       double arc_rad, py::handle facing) {
             return Horseshoe{vector_of(centre_m, {"Horseshoe", "centre_m"}), arc_radius_m,
                              half_width_m, arc_rad, vector_of(facing, {"Horseshoe", "facing"})};
           }),
           "centre_m"_a, "arc_radius_m"_a, "half_width_m"_a, py::kw_only(),
           "arc_rad"_a = Horseshoe().arc_rad, "facing"_a = py::make_tuple(1.0, 0.0, 0.0),
           "arc_rad: the solid part; facing: from the centre to the middle of the arc.");
  py::class_<Outline>(module, "Outline",
                      "A closed outline through points of the tissue, joined by shortest paths.")
      .def(py::init([](py::handle points_m) {
             return Outline{rows_of(points_of(points_m, {"Outline", "points_m"}))};
           }),
           "points_m"_a, "n x 3, metres.");
}

void bind_random(py::module_& module) {
  py::class_<Stream>(module, "Random",
                     "A stream of random numbers, the same on every machine; palpate's.")
      .def(py::init([](std::uint64_t seed) { return std::make_unique<Stream>(Random(seed)); }),
           "seed"_a)
      .def(
          "uniform", [](Stream& stream) { return stream.take("Random")->uniform(); }, "In [0, 1).")
      .def(
          "normal", [](Stream& stream) { return stream.take("Random")->normal(); },
          "Standard normal.");
}

}  // namespace

void bind_phantom(py::module_& module) {
  bind_tumours(module);
  bind_random(module);
  py::class_<Simulated>(module, "Phantom",
                        "Simulated tissue with tumours under it (Garg et al. 2016, equation 4).")
      .def(py::init([](const Surface& surface, std::vector<Tumour> tumours, double low, double high,
                       double slope_per_m, double noise, double bias, const py::object& bias_axis,
                       double fraction, double lag_m) {
             return phantom_of(surface, std::move(tumours),
                               {.low = low,
                                .high = high,
                                .slope_per_m = slope_per_m,
                                .noise = noise,
                                .bias = bias,
                                .fraction = fraction,
                                .lag_m = lag_m},
                               bias_axis);
           }),
           "surface"_a, "tumours"_a, py::kw_only(), "low"_a = 7.0, "high"_a = 9.0,
           "slope_per_m"_a = 1400.0, "noise"_a = 0.0, "bias"_a = 0.0, "bias_axis"_a = py::none(),
           "fraction"_a = 0.5, "lag_m"_a = 0.0,
           "low and high: readings beside and deep inside a tumour. noise: standard deviation as a "
           "fraction of high - low. bias: the paper's beta, along bias_axis. lag_m: how late "
           "readings come.")
      .def("touch", &touched, "where"_a, "random"_a, py::kw_only(), "travel"_a = py::none(),
           "Readings at vertices or positions, with noise and bias; travel: n x 3, unit.")
      .def(
          "true_region",
          [](const Simulated& world) {
            return long_call([&] {
              return superlevel_region(world.surface, world.phantom.truth(),
                                       world.phantom.true_level());
            });
          },
          "What is to be found: a region of the chart.")
      .def_property_readonly(
          "truth",
          [](py::object self) { return view_of(self.cast<Simulated&>().phantom.truth(), self); },
          "At the vertices, free of noise and bias, read-only.")
      .def_property_readonly("true_level",
                             [](const Simulated& world) { return world.phantom.true_level(); })
      .def_property_readonly("surface", [](const Simulated& world) { return world.surface; });
}

}  // namespace palpation::python
