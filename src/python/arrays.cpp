#include "python/arrays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "palpation/base/error.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

constexpr py::ssize_t kMostRows = py::ssize_t{1} << 27;  // as of vertices

std::string start_of(const Argument& argument) {
  return std::string(argument.function) + ": " + argument.name + ": ";
}

[[noreturn]] void refuse(const Argument& argument, const std::string& words) {
  throw InvalidInput(start_of(argument) + words);
}

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

/// numpy's masked arrays lose their mask on the way into an array.
bool is_masked(py::handle given) {
  return py::hasattr(given, "mask") && py::hasattr(given, "fill_value");
}

/// Of real numbers, or with `whole` of whole ones.
py::array numeric(py::handle given, const Argument& argument, bool whole) {
  const py::array array = py::module_::import("numpy").attr("asarray")(given).cast<py::array>();
  if (is_masked(given)) refuse(argument, "is a masked array: fill or drop what is masked first");
  const char kind = array.dtype().kind();
  const bool is_empty_list = array.size() == 0 && !py::isinstance<py::array>(given);
  if (!(kind == 'i' || kind == 'u' || (kind == 'f' && (!whole || is_empty_list))))
    throw py::type_error(start_of(argument) + "is of " +
                         py::repr(array.dtype()).cast<std::string>() + ", must be of " +
                         (whole ? "whole numbers" : "real numbers"));
  return array;
}

void check_shape(const py::array& array, const Argument& argument, py::ssize_t columns) {
  const bool fits =
      columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  const std::string rule = columns == 0 ? "(n,)" : "(n, " + std::to_string(columns) + ")";
  if (!fits) refuse(argument, "has the shape " + shape_text(array) + ", must be " + rule);
  if (array.shape(0) > kMostRows)
    refuse(argument, "has " + std::to_string(array.shape(0)) + " rows, must have at most 2^27");
}

/// Contiguous, rows first, and where numbers of that size may lie: numpy has arrays out of line.
template <typename Number>
py::array_t<Number, py::array::c_style> packed(const py::array& array) {
  constexpr int kAligned = py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  using Packed = py::array_t<Number, py::array::c_style | py::array::forcecast | kAligned>;
  const Packed result = Packed::ensure(array);
  if (!result) throw py::error_already_set();
  return result;
}

std::string row_text(const double* row, py::ssize_t columns) {
  if (columns <= 1) return text_of(*row);
  std::string text = "(";
  for (py::ssize_t i = 0; i < columns; ++i) text += (i == 0 ? "" : ", ") + text_of(row[i]);
  return text + ")";
}

void check_finite(const py::array_t<double, py::array::c_style>& array, const Argument& argument,
                  py::ssize_t columns, Missing missing) {
  const double* numbers = array.data();
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (std::isfinite(numbers[i]) || (missing == Missing::Welcome && std::isnan(numbers[i])))
      continue;
    const py::ssize_t width = std::max<py::ssize_t>(columns, 1);
    refuse(argument, "row " + std::to_string(i / width) + " is " +
                         row_text(numbers + i / width * width, columns) + ", must be finite");
  }
}

py::array_t<double, py::array::c_style> reals(py::handle given, const Argument& argument,
                                              py::ssize_t columns, Missing missing) {
  const py::array array = numeric(given, argument, false);
  check_shape(array, argument, columns);
  const auto result = packed<double>(array);
  check_finite(result, argument, columns, missing);
  return result;
}

/// Checked to lie from 0 to below `end`.
template <typename Wide>
void copy_whole(const py::array& array, const Argument& argument, std::int64_t end, int* target) {
  const auto numbers = packed<Wide>(array);
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const Wide number = numbers.data()[i];
    if (number < 0 || static_cast<std::uint64_t>(number) >= static_cast<std::uint64_t>(end))
      refuse(argument, "entry " + std::to_string(i) + " is " + std::to_string(number) +
                           ", must be from 0 to " + std::to_string(end - 1));
    target[i] = static_cast<int>(number);
  }
}

void copy_integers(const py::array& array, const Argument& argument, std::int64_t end,
                   int* target) {
  if (array.dtype().kind() == 'u') return copy_whole<std::uint64_t>(array, argument, end, target);
  copy_whole<std::int64_t>(array, argument, end, target);
}

template <typename Number>
py::array frozen(const Number* first, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array_t<Number> array(std::move(shape), first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <typename Matrix>
py::array view_of_rows(const Matrix& matrix, py::handle owner) {
  return frozen(matrix.data(), {matrix.rows(), matrix.cols()}, owner);
}

template <typename Matrix>
py::array copy_of_rows(const Matrix& matrix) {
  return py::array_t<typename Matrix::Scalar>({matrix.rows(), matrix.cols()}, matrix.data());
}

}  // namespace

Points points_of(py::handle given, const Argument& argument) {
  const auto array = reals(given, argument, 3, Missing::Refused);
  return Eigen::Map<const Points>(array.data(), array.shape(0), 3);
}

Points2 places_of(py::handle given, const Argument& argument) {
  const auto array = reals(given, argument, 2, Missing::Refused);
  return Eigen::Map<const Points2>(array.data(), array.shape(0), 2);
}

Triangles triangles_of(py::handle given, const Argument& argument) {
  const py::array array = numeric(given, argument, true);
  check_shape(array, argument, 3);
  Triangles triangles(array.shape(0), 3);
  copy_integers(array, argument, std::int64_t{1} << 31, triangles.data());
  return triangles;
}

Eigen::VectorXd numbers_of(py::handle given, const Argument& argument, Missing missing) {
  const auto array = reals(given, argument, 0, missing);
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.size());
}

Eigen::VectorXd numbers_of(py::handle given, const Argument& argument, Eigen::Index count,
                           Missing missing) {
  Eigen::VectorXd numbers = numbers_of(given, argument, missing);
  if (numbers.size() != count)
    refuse(argument, "has " + std::to_string(numbers.size()) + " numbers, must have " +
                         std::to_string(count));
  return numbers;
}

Eigen::VectorXd spread_of(py::handle given, const Argument& argument, Eigen::Index count,
                          Missing missing) {
  const py::array array = numeric(given, argument, false);
  if (array.ndim() != 0) return numbers_of(array, argument, count, missing);
  const auto number = packed<double>(array);
  check_finite(number, argument, 0, missing);
  return Eigen::VectorXd::Constant(count, *number.data());
}

Vec3 vector_of(py::handle given, const Argument& argument) {
  return numbers_of(given, argument, Eigen::Index{3});
}

Vec2 pair_of(py::handle given, const Argument& argument) {
  return numbers_of(given, argument, Eigen::Index{2});
}

std::vector<int> indices_of(py::handle given, const Argument& argument, int count) {
  const py::array array = numeric(given, argument, true);
  check_shape(array, argument, 0);
  std::vector<int> indices(static_cast<std::size_t>(array.size()));
  if (!indices.empty()) copy_integers(array, argument, count, indices.data());
  return indices;
}

bool is_list_of_integers(py::handle given) {
  const py::array array = py::module_::import("numpy").attr("asarray")(given).cast<py::array>();
  const char kind = array.dtype().kind();
  return array.ndim() == 1 && (kind == 'i' || kind == 'u' || array.size() == 0);
}

py::array view_of(const Points& points, py::handle owner) { return view_of_rows(points, owner); }
py::array view_of(const Points2& points, py::handle owner) { return view_of_rows(points, owner); }
py::array view_of(const Triangles& triangles, py::handle owner) {
  return view_of_rows(triangles, owner);
}
py::array view_of(const Eigen::VectorXd& numbers, py::handle owner) {
  return frozen(numbers.data(), {numbers.size()}, owner);
}

py::array array_of(const Eigen::VectorXd& numbers) {
  return py::array_t<double>(numbers.size(), numbers.data());
}
py::array array_of(const Points& points) { return copy_of_rows(points); }
py::array array_of(const Points2& points) { return copy_of_rows(points); }
py::array array_of(const Triangles& triangles) { return copy_of_rows(triangles); }
py::array array_of(const std::vector<int>& numbers) {
  return py::array_t<int>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace palpation::python
