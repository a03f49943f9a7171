#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/exploration/exploration.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/concluded.h"
#include "python/exclusive.h"
#include "python/long_call.h"
#include "python/planned.h"
#include "python/readings.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

/// Where to touch next.
struct Stops {
  Surface surface;
  std::vector<int> vertices;
  Points travel;
  int batch;

  std::vector<SurfacePoint> places() const {
    std::vector<SurfacePoint> all;
    for (const int vertex : vertices) all.push_back(surface.at_vertex(vertex));
    return all;
  }
};

/// An exploration, and where the probe is.
struct Explorer {
  Exploration exploration;
  std::optional<SurfacePoint> probe{};
};

using Shared = Exclusive<Explorer>;
constexpr const char* kName = "Exploration";

/// The directions in which the stops are reached, one after the other, to the bit as `travel` has
/// them.
Points directions(const Surface& surface, const std::vector<int>& stops,
                  const std::optional<SurfacePoint>& probe) {
  Points travel = Points::Zero(static_cast<Eigen::Index>(stops.size()), 3);
  std::optional<Vec3> here;
  if (probe) here = surface.position(*probe);
  for (Eigen::Index row = 0; row < travel.rows(); ++row) {
    const Vec3 there = surface.position(surface.at_vertex(stops[static_cast<std::size_t>(row)]));
    const Vec3 way = there - here.value_or(there);
    const double length = way.norm();
    if (length > 0.0) travel.row(row) = Vec3(way / length).transpose();
    here = there;
  }
  return travel;
}

Stops stops_of(const Explorer& explorer) {
  const Exploration& exploration = explorer.exploration;
  return {exploration.surface(), exploration.next(),
          directions(exploration.surface(), exploration.next(), explorer.probe),
          exploration.batch()};
}

Stops ask(Shared& shared) {
  const auto explorer = shared.take(kName);
  return long_call([&] { return stops_of(*explorer); });
}

void tell_readings(Explorer& explorer, const Readings& readings) {
  require_same_surface(explorer.exploration.surface(), readings.surface, "Exploration.tell");
  long_call([&] {
    explorer.exploration.record(readings.palpations);
    return true;
  });
  if (!readings.palpations.empty()) explorer.probe = readings.palpations.back().where;
}

/// One for each stop, in the order in which they were asked for.
void tell_values(Explorer& explorer, const py::object& values, const py::object& noise_variance) {
  const Stops stops = long_call([&] { return stops_of(explorer); });
  require(!stops.vertices.empty(), "Exploration.tell", "readings",
          "come when nothing is asked for");
  const std::vector<Palpation> felt =
      palpations_of(stops.places(), {values, noise_variance, view_of(stops.travel, py::none())},
                    "Exploration.tell");
  long_call([&] {
    explorer.exploration.record(felt);
    return true;
  });
  explorer.probe = stops.places().back();
}

void tell(Shared& shared, const py::object& readings, const py::object& noise_variance) {
  const auto explorer = shared.take(kName);
  if (!py::isinstance<Readings>(readings)) return tell_values(*explorer, readings, noise_variance);
  require(noise_variance.is_none(), "Exploration.tell", "noise_variance",
          "is part of Readings: give it there");
  tell_readings(*explorer, readings.cast<const Readings&>());
}

void take_up(Shared& shared, const Readings& readings) {
  const auto explorer = shared.take(kName);
  require_same_surface(explorer->exploration.surface(), readings.surface, "Exploration.take_up");
  long_call([&] {
    explorer->exploration.take_up(readings.palpations);
    return true;
  });
  if (!readings.palpations.empty()) explorer->probe = readings.palpations.back().where;
}

std::unique_ptr<Shared> exploration_of(const Surface& surface, const Model& model,
                                       const py::object& plan, const py::object& reach,
                                       bool touch_once,
                                       std::optional<std::uint64_t> outlines_seed) {
  Reach within{.touch_once = touch_once};
  if (!reach.is_none()) {
    within.vertices = indices_of(reach, {kName, "reach"}, surface.vertex_count());
    require(!within.vertices->empty(), kName, "reach", "must name a vertex at least");
  }
  const Plan planned = plan.is_none() ? Plan() : plan.cast<const Planned&>().plan;
  return std::make_unique<Shared>(long_call([&] {
    return Explorer{Exploration(surface, model, planned, std::move(within), outlines_seed)};
  }));
}

void bind_stops(py::module_& module) {
  py::class_<Stops>(module, "Stops", "Where to touch next, in the order of travel.")
      .def_property_readonly(
          "vertices", [](const Stops& here) { return array_of(here.vertices); }, "n vertices.")
      .def_property_readonly(
          "positions",
          [](const Stops& here) {
            Points positions(static_cast<Eigen::Index>(here.vertices.size()), 3);
            for (Eigen::Index row = 0; row < positions.rows(); ++row)
              positions.row(row) =
                  here.surface.vertex(here.vertices[static_cast<std::size_t>(row)]).transpose();
            return array_of(positions);
          },
          "n x 3, metres in the mesh's frame.")
      .def_property_readonly(
          "travel", [](const Stops& here) { return array_of(here.travel); },
          "n x 3: the unit direction in which each is reached from the one before; zeros where it "
          "is not known where the probe was.")
      .def_readonly("batch", &Stops::batch, "Which batch this is, from 0.")
      .def("__len__", [](const Stops& here) { return here.vertices.size(); })
      .def("__repr__", [](const Stops& here) {
        return "<palpation.Stops: " + std::to_string(here.vertices.size()) + " of batch " +
               std::to_string(here.batch) + ">";
      });
}

using ExplorationClass = py::class_<Shared>;

void bind_state(ExplorationClass& exploration) {
  exploration
      .def_property_readonly(
          "surface", [](Shared& shared) { return shared.take(kName)->exploration.surface(); })
      .def_property_readonly(
          "conclusion",
          [](Shared& shared) {
            const auto explorer = shared.take(kName);
            return Concluded(explorer->exploration.surface(), explorer->exploration.conclusion());
          },
          "All that follows from what was told. It stays as it is when more is told.")
      .def_property_readonly(
          "readings",
          [](Shared& shared) {
            const auto explorer = shared.take(kName);
            return Readings{explorer->exploration.surface(), explorer->exploration.readings()};
          },
          "All in the order in which they came, those that could not be made too.")
      .def_property_readonly(
          "batch", [](Shared& shared) { return shared.take(kName)->exploration.batch(); },
          "How many batches were told.")
      .def_property_readonly(
          "stop_reason",
          [](Shared& shared) -> py::object {
            const auto explorer = shared.take(kName);
            if (!explorer->exploration.next().empty()) return py::none();
            return py::str(explorer->exploration.stop_reason());
          },
          "Why ask() names no stops; None while it does.")
      .def(
          "scores",
          [](Shared& shared) {
            const auto explorer = shared.take(kName);
            return array_of(long_call([&] {
              return acquisition_field(explorer->exploration.conclusion(),
                                       explorer->exploration.plan());
            }));
          },
          "What the next batch maximizes, at the vertices.");
}

}  // namespace

void bind_exploration(py::module_& module) {
  bind_stops(module);
  ExplorationClass exploration(module, "Exploration",
                               "Ask and tell: where to touch next, given all that was felt so far."
                               "\n\n    while stops := exploration.ask():\n"
                               "        exploration.tell(touch(stops.positions))");
  exploration
      .def(
          py::init(&exploration_of), "surface"_a, "model"_a = Model(), "plan"_a = py::none(),
          py::kw_only(), "reach"_a = py::none(), "touch_once"_a = false,
          "outlines_seed"_a = py::none(),
          "reach: the vertices that may be touched, rising; None: all. touch_once: no vertex "
          "twice. outlines_seed: the plan's stop_error_m2 and stop_band_m are reasons to stop only "
          "where outlines that are drawn keep them, too, as the tool has it.")
      .def("ask", &ask,
           "The next stops; none when it is finished (see stop_reason). Changes nothing.")
      .def("tell", &tell, "readings"_a, py::kw_only(), "noise_variance"_a = py::none(),
           "What was felt: one number for each stop of the last ask(), in its order, NaN where "
           "there was no contact; or Readings of any places, then stops that are not among them "
           "gave no contact. When it raises, nothing was recorded.")
      .def("take_up", &take_up, "readings"_a,
           "Readings that were made elsewhere or before: says nothing of the stops that are asked "
           "for.")
      .def(
          "foresee",
          [](Shared& shared) {
            const auto explorer = shared.take(kName);
            long_call([&] {
              explorer->exploration.foresee();
              return true;
            });
          },
          "For the time while the robot moves: does the work that no reading changes.");
  exploration.def(
      "draw_outlines",
      [](Shared& shared, std::uint64_t seed) {
        const auto explorer = shared.take(kName);
        long_call([&] {
          explorer->exploration.draw_outlines(seed);
          return true;
        });
      },
      "seed"_a = 1,
      "Concludes from the same readings once more, the boundary's outlines drawn: what the end of "
      "a run may take its time for. The next stops stay as they are.");
  bind_state(exploration);
}

}  // namespace palpation::python
