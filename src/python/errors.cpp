#include "python/errors.h"

#include <exception>
#include <string>

#include "palpation/base/error.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

/// They live as long as the process: what translates outlives the module.
struct Types {
  PyObject* error = nullptr;
  PyObject* invalid_input = nullptr;
  PyObject* io_error = nullptr;
  PyObject* write_error = nullptr;
  PyObject* invalid_mesh = nullptr;
  PyObject* numerical_error = nullptr;
};
Types types;

PyObject* make(py::module_& module, const char* name, const char* words, const py::tuple& bases) {
  const std::string full_name = std::string("palpation.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), words, bases.ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.attr(name) = py::handle(type);
  return type;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const WriteError& error) {
    PyErr_SetString(types.write_error, error.what());
  } catch (const IoError& error) {
    PyErr_SetString(types.io_error, error.what());
  } catch (const InvalidInput& error) {
    PyErr_SetString(types.invalid_input, error.what());
  } catch (const InvalidMesh& error) {
    PyErr_SetString(types.invalid_mesh, error.what());
  } catch (const NumericalError& error) {
    PyErr_SetString(types.numerical_error, error.what());
  } catch (const Error& error) {
    PyErr_SetString(types.error, error.what());
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  const auto with = [](PyObject* first, PyObject* second) {
    return py::make_tuple(py::handle(first), py::handle(second));
  };
  types.error = make(module, "Error", "Root of all errors that the library raises on purpose.",
                     py::make_tuple(py::handle(PyExc_Exception)));
  types.invalid_input = make(module, "InvalidInput",
                             "An argument breaks a rule: the message names function, value and "
                             "rule.",
                             with(types.error, PyExc_ValueError));
  types.io_error =
      make(module, "IoError", "A file is at fault: the message names path, line or byte, and rule.",
           with(types.error, PyExc_OSError));
  types.write_error = make(module, "WriteError", "A file could not be written.",
                           py::make_tuple(py::handle(types.io_error)));
  types.invalid_mesh = make(module, "InvalidMesh",
                            "A mesh is no surface: the message names the element, its place and "
                            "the rule.",
                            with(types.error, PyExc_ValueError));
  types.numerical_error =
      make(module, "NumericalError", "The arithmetic failed: the message names step and quantity.",
           with(types.error, PyExc_ArithmeticError));
  py::register_exception_translator(&translate);
}

}  // namespace palpation::python
