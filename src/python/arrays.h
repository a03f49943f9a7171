/// numpy arrays in and out.
///
/// In: anything that numpy makes an array of numbers of. Copied, so that nothing changes behind
/// anybody's back. Throws TypeError for what holds no real numbers, InvalidInput for a wrong shape,
/// a masked array, more than 2^27 rows and numbers that are not finite, naming function, argument
/// and row.
/// Out: read-only views of what an immutable object holds, without a copy; they keep it alive.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "palpation/base/types.h"

namespace palpation::python {

/// Whose argument it is, for messages.
struct Argument {
  const char* function;
  const char* name;
};

Points points_of(pybind11::handle given, const Argument& argument);        // n x 3
Points2 places_of(pybind11::handle given, const Argument& argument);       // n x 2
Triangles triangles_of(pybind11::handle given, const Argument& argument);  // m x 3 integers
/// n numbers; NaN is welcome where it has a meaning.
enum class Missing { Refused, Welcome };
Eigen::VectorXd numbers_of(pybind11::handle given, const Argument& argument,
                           Missing missing = Missing::Refused);
/// The same where there must be `count`.
Eigen::VectorXd numbers_of(pybind11::handle given, const Argument& argument, Eigen::Index count,
                           Missing missing = Missing::Refused);
/// One number for all, or one for each of `count`.
Eigen::VectorXd spread_of(pybind11::handle given, const Argument& argument, Eigen::Index count,
                          Missing missing = Missing::Refused);
Vec3 vector_of(pybind11::handle given, const Argument& argument);
Vec2 pair_of(pybind11::handle given, const Argument& argument);
/// Whole numbers from 0 to below `count`.
std::vector<int> indices_of(pybind11::handle given, const Argument& argument, int count);
/// Whether it is an array of whole numbers in one dimension: vertices, and not places.
bool is_list_of_integers(pybind11::handle given);

/// Read-only views that keep `owner` alive.
pybind11::array view_of(const Points& points, pybind11::handle owner);
pybind11::array view_of(const Points2& points, pybind11::handle owner);
pybind11::array view_of(const Triangles& triangles, pybind11::handle owner);
pybind11::array view_of(const Eigen::VectorXd& numbers, pybind11::handle owner);

/// Arrays of their own, which the caller may write to.
pybind11::array array_of(const Eigen::VectorXd& numbers);
pybind11::array array_of(const Points& points);
pybind11::array array_of(const Points2& points);
pybind11::array array_of(const Triangles& triangles);
pybind11::array array_of(const std::vector<int>& numbers);

}  // namespace palpation::python
