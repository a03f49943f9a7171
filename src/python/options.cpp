#include "python/options.h"

#include <cmath>
#include <limits>

namespace py = pybind11;

namespace palpation::python {

Options::Options(const char* of, const py::dict& defaults, const py::kwargs& given)
    : of_(of), values_(defaults.attr("copy")()) {
  for (const auto& [name, value] : given) {
    if (!values_.contains(name)) {
      std::string all;
      for (const auto& [known, unused] : values_)
        all += (all.empty() ? "" : ", ") + known.cast<std::string>();
      throw py::type_error(std::string(of_) + ": there is no argument '" +
                           name.cast<std::string>() + "': there are " + all);
    }
    values_[name] = value;
  }
}

double Options::number(const char* name) const {
  const py::object given = values_[name];
  if (PyBool_Check(given.ptr()) || !(PyFloat_Check(given.ptr()) || PyIndex_Check(given.ptr()) ||
                                     py::hasattr(given, "__float__")))
    refuse_type(name, "a number");
  const double value = py::float_(given);
  require(std::isfinite(value), of_, name + (" = " + text_of(value)), "must be finite");
  return value;
}

int Options::integer(const char* name) const {
  const py::object given = values_[name];
  if (PyBool_Check(given.ptr()) || !PyIndex_Check(given.ptr())) refuse_type(name, "a whole number");
  int overflow = 0;
  const py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!whole) throw py::error_already_set();
  const long value = PyLong_AsLongAndOverflow(whole.ptr(), &overflow);
  require(overflow == 0 && value >= std::numeric_limits<int>::min() &&
              value <= std::numeric_limits<int>::max(),
          of_, std::string(name) + " = " + py::str(whole).cast<std::string>(),
          "must be below 2^31 in size");
  return static_cast<int>(value);
}

std::uint64_t Options::seed(const char* name) const {
  const py::object given = values_[name];
  if (PyBool_Check(given.ptr()) || !PyIndex_Check(given.ptr())) refuse_type(name, "a whole number");
  const py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!whole) throw py::error_already_set();
  const unsigned long long value = PyLong_AsUnsignedLongLong(whole.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw InvalidInput(std::string(of_) + ": " + name + " = " + py::str(whole).cast<std::string>() +
                       " must be from 0 to 2^64 - 1");
  }
  return value;
}

bool Options::truth(const char* name) const {
  const py::object given = values_[name];
  if (!PyBool_Check(given.ptr())) refuse_type(name, "True or False");
  return given.ptr() == Py_True;
}

std::string Options::text(const char* name) const {
  const py::object given = values_[name];
  if (!py::isinstance<py::str>(given)) refuse_type(name, "a word");
  return given.cast<std::string>();
}

Learnable Options::learnable(const char* name) const {
  if (!py::isinstance<py::str>(values_[name])) return number(name);
  const std::string word = text(name);
  require(word == "learn", of_, std::string(name) + " '" + word + "'",
          "must be a number or 'learn'");
  return kLearned;
}

void Options::refuse_type(const char* name, const char* rule) const {
  throw py::type_error(std::string(of_) + ": " + name + " must be " + rule + ", not " +
                       py::str(py::type::handle_of(values_[name])).cast<std::string>());
}

py::object value_of(const Learnable& learnable) {
  if (learnable.is_learned()) return py::str("learn");
  return py::float_(*learnable.given());
}

std::string call_text(const char* of, const py::dict& values) {
  std::string text;
  for (const auto& [name, value] : values)
    text += (text.empty() ? "" : ", ") + name.cast<std::string>() + "=" +
            py::repr(value).cast<std::string>();
  return std::string(of) + "(" + text + ")";
}

}  // namespace palpation::python
