#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/measurements.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/places_on.h"
#include "python/readings.h"
#include "python/warn.h"

namespace py = pybind11;
using namespace py::literals;

namespace palpation::python {
namespace {

using ReadingsClass = py::class_<Readings>;

constexpr int kLastBatch = 1'000'000;  // as a measurements file has it

TouchKind kind_of(const std::string& word) {
  if (word == "stop") return TouchKind::Stop;
  require(word == "way", "Readings", "kind '" + word + "'", "must be 'stop' or 'way'");
  return TouchKind::Way;
}

const char* word_of(TouchKind kind) {
  if (kind == TouchKind::Missed) return "missed";
  return kind == TouchKind::Way ? "way" : "stop";
}

Readings made(const Surface& surface, py::handle where, const Felt& felt, const std::string& kind,
              int batch) {
  const TouchKind touch = kind_of(kind);
  require(batch >= 0 && batch <= kLastBatch, "Readings", "batch " + std::to_string(batch),
          "must be from 0 to 1000000");
  Readings readings{
      surface, palpations_of(places_on(surface, where, {"Readings", "where"}), felt, "Readings")};
  for (Palpation& palpation : readings.palpations) {
    palpation.batch = batch;
    if (palpation.kind == TouchKind::Stop) palpation.kind = touch;
  }
  return readings;
}

template <typename Get>
Eigen::VectorXd each(const Readings& readings, const Get& get) {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(readings.palpations.size()));
  for (Eigen::Index row = 0; row < numbers.size(); ++row)
    numbers[row] = get(readings.palpations[static_cast<std::size_t>(row)]);
  return numbers;
}

template <typename Get>
Points each_point(const Readings& readings, const Get& get) {
  Points points(static_cast<Eigen::Index>(readings.palpations.size()), 3);
  for (Eigen::Index row = 0; row < points.rows(); ++row)
    points.row(row) = get(readings.palpations[static_cast<std::size_t>(row)]).transpose();
  return points;
}

std::vector<int> batches_of(const Readings& readings) {
  std::vector<int> batches;
  for (const Palpation& palpation : readings.palpations) batches.push_back(palpation.batch);
  return batches;
}

std::vector<std::string> kinds_of(const Readings& readings) {
  std::vector<std::string> kinds;
  for (const Palpation& palpation : readings.palpations) kinds.push_back(word_of(palpation.kind));
  return kinds;
}

std::vector<std::string> reasons_of(const Readings& readings) {
  std::vector<std::string> reasons;
  for (const Palpation& palpation : readings.palpations) reasons.push_back(palpation.set_aside);
  return reasons;
}

py::array positions_of(const Readings& readings) {
  return array_of(each_point(
      readings, [&](const Palpation& one) { return readings.surface.position(one.where); }));
}

py::dict dictionary_of(const py::object& self) {
  py::dict result;
  for (const char* name :
       {"positions", "values", "noise_variance", "batch", "kind", "travel", "set_aside"})
    result[name] = self.attr(name);
  return result;
}

Readings joined(const Readings& first, const Readings& second) {
  require_same_surface(first.surface, second.surface, "Readings");
  Readings all = first;
  all.palpations.insert(all.palpations.end(), second.palpations.begin(), second.palpations.end());
  return all;
}

void bind_columns(ReadingsClass& readings) {
  readings.def_property_readonly("positions", &positions_of, "n x 3, metres in the mesh's frame.")
      .def_property_readonly(
          "values",
          [](const Readings& here) {
            return array_of(each(here, [](const Palpation& one) { return one.reading; }));
          },
          "n, in the sensor's unit; NaN where a stop could not be touched.")
      .def_property_readonly(
          "noise_variance",
          [](const Readings& here) {
            return array_of(each(here, [](const Palpation& one) { return one.noise_variance; }));
          },
          "n; NaN: the field's noise.")
      .def_property_readonly(
          "travel",
          [](const Readings& here) {
            return array_of(each_point(here, [](const Palpation& one) { return one.travel; }));
          },
          "n x 3: unit directions of travel, zeros where unknown.")
      .def_property_readonly(
          "batch", [](const Readings& here) { return array_of(batches_of(here)); }, "n, from 0.")
      .def_property_readonly("kind", &kinds_of, "n words: 'stop', 'way' or 'missed'.")
      .def_property_readonly("set_aside", &reasons_of,
                             "n texts: why a reading is not used; empty where it is.");
}

}  // namespace

void bind_readings(py::module_& module) {
  ReadingsClass readings(module, "Readings",
                         "What was felt, and where, in the order in which it was felt.");
  readings.def(
      py::init([](const Surface& surface, py::object where, py::object values,
                  py::object noise_variance, py::object travel, const std::string& kind,
                  int batch) {
        return made(surface, where,
                    {std::move(values), std::move(noise_variance), std::move(travel)}, kind, batch);
      }),
      "surface"_a, "where"_a, "values"_a, py::kw_only(), "noise_variance"_a = py::none(),
      "travel"_a = py::none(), "kind"_a = "stop", "batch"_a = 0,
      "where: vertices (n whole numbers) or positions on the tissue (n x 3, metres). values: n; "
      "NaN: could not be touched.");
  bind_columns(readings);
  readings.def_property_readonly("surface", [](const Readings& here) { return here.surface; })
      .def("as_dict", &dictionary_of, "The columns by their names: for pandas.DataFrame and such.")
      .def(
          "to_csv",
          [](const Readings& here) { return measurements_csv(here.surface, here.palpations); },
          "The text of a measurements.csv, as palpate writes and reads it.")
      .def_static(
          "read_csv",
          [](const std::filesystem::path& path, const Surface& surface) {
            const MeasurementsFile file =
                long_call([&] { return read_measurements(path, surface); });
            warn(file.warnings);
            return Readings{surface, file.palpations};
          },
          "path"_a, "surface"_a,
          "A measurements.csv. What looks odd is a UserWarning. Raises IoError with line and "
          "column.")
      .def("__len__", [](const Readings& here) { return here.palpations.size(); })
      .def("__add__", &joined, py::is_operator(), "The other's behind these.")
      .def("__repr__", [](const Readings& here) {
        return "<palpation.Readings: " + std::to_string(here.palpations.size()) + ">";
      });
}

}  // namespace palpation::python
