/// What a session is told, from what Python gives.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "python/arrays.h"
#include "python/open_session.h"
#include "python/readings.h"

namespace palpation::python {

struct RecordGiven {
  pybind11::object where;  ///< None, vertices or positions
  pybind11::object stop;   ///< None, or n whole numbers
  Felt felt;
  pybind11::object t;  ///< None, a number, or n numbers [s]; NaN: not known
  std::string kind, why;
};

/// One a number. Without `where` and `stop` they answer the open stops in their order, with `stop`
/// those stops, at their places. Throws as arrays.h and readings.h say, naming `Session.record`.
std::vector<Told> told_rows(const Surface& surface, const SessionState& state,
                            const RecordGiven& given);

/// The same of readings that carry their places.
std::vector<Told> told_rows(const Surface& surface, const Readings& readings,
                            const pybind11::object& t);

/// The numbers of stops: a number, or n of them, below `count`.
std::vector<int> stop_numbers(pybind11::handle given, const Argument& argument, int count);

}  // namespace palpation::python
