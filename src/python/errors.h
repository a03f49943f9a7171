/// The library's errors as Python's, one to one.
#pragma once

#include <pybind11/pybind11.h>

namespace palpation::python {

/// Error(Exception), InvalidInput(Error, ValueError), IoError(Error, OSError), WriteError(IoError),
/// InvalidMesh(Error, ValueError) and NumericalError(Error, ArithmeticError) of the module, and the
/// translation into them.
void bind_errors(pybind11::module_& module);

}  // namespace palpation::python
