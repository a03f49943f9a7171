#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "palpation/io/csv.h"
#include "palpation/session/session_state.h"
#include "python/arrays.h"
#include "python/bindings.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

const char* word_of(StopState state) {
  if (state == StopState::Touched) return "touched";
  if (state == StopState::Missed) return "missed";
  return state == StopState::Open ? "open" : "dropped";
}

std::vector<std::string> states_of(const HandedOut& plan) {
  std::vector<std::string> states;
  for (const StopState state : plan.stops) states.emplace_back(word_of(state));
  return states;
}

std::vector<int> open_of(const HandedOut& plan) {
  std::vector<int> open;
  for (std::size_t i = 0; i < plan.stops.size(); ++i)
    if (plan.stops[i] == StopState::Open) open.push_back(static_cast<int>(i));
  return open;
}

py::array positions_of(const HandedOut& plan) {
  Points positions(static_cast<Eigen::Index>(plan.plan.stops.size()), 3);
  for (Eigen::Index row = 0; row < positions.rows(); ++row)
    positions.row(row) = plan.plan.stops[static_cast<std::size_t>(row)].transpose();
  return array_of(positions);
}

/// The columns of a table of numbers by their names.
py::dict columns_of(const std::string& csv, const std::string& name) {
  const CsvTable table = parse_csv(csv, name);
  py::dict columns;
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(table.row_count()));
    for (std::size_t row = 0; row < table.row_count(); ++row)
      numbers[static_cast<Eigen::Index>(row)] = finite_number_at(table, row, column);
    columns[py::str(table.columns()[column])] = array_of(numbers);
  }
  return columns;
}

}  // namespace

void bind_session_plan(py::module_& module) {
  py::class_<HandedOut>(module, "SessionPlan",
                        "Where to touch, as a session handed it out, in the order of travel.")
      .def_readonly("number", &HandedOut::number, "From 0.")
      .def_readonly("batch", &HandedOut::batch, "Of its readings.")
      .def_readonly("used", &HandedOut::used, "The rows that it was made from: '1-16,18-30'.")
      .def_property_readonly("positions", &positions_of, "n x 3, metres in the mesh's frame.")
      .def_property_readonly(
          "open", [](const HandedOut& plan) { return array_of(open_of(plan)); },
          "The stops that nothing had become of when it was handed out, from 0.")
      .def_property_readonly("states", &states_of,
                             "n words: 'open', 'touched', 'missed' or 'dropped'.")
      .def_property_readonly(
          "stop_reason",
          [](const HandedOut& plan) -> py::object {
            if (!plan.plan.stops.empty()) return py::none();
            return py::str(plan.plan.stop_reason);
          },
          "Why there are no stops; None where there are.")
      .def_property_readonly(
          "poses",
          [](const HandedOut& plan) { return columns_of(plan.plan.waypoints_csv, "waypoints"); },
          "The columns of waypoints.csv by their names: the stops in the robot's frame, metres.")
      .def_property_readonly(
          "waypoints_csv", [](const HandedOut& plan) { return plan.plan.waypoints_csv; },
          "The text of a waypoints.csv.")
      .def_property_readonly(
          "path_csv", [](const HandedOut& plan) { return plan.plan.path_csv; },
          "The text of a path.csv: the way between the stops.")
      .def("__len__", [](const HandedOut& plan) { return plan.plan.stops.size(); })
      .def("__repr__", [](const HandedOut& plan) {
        return "<palpation.SessionPlan " + std::to_string(plan.number) + ": " +
               std::to_string(plan.plan.stops.size()) + " stops>";
      });
}

}  // namespace palpation::python
