/// What was repaired or looks odd, told as Python tells such things.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace palpation::python {

/// A UserWarning each. Throws what the warning raises where the user turns warnings into errors.
inline void warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0)
      throw pybind11::error_already_set();
  }
}

}  // namespace palpation::python
