/// The classes and functions of the module, one function a file.
#pragma once

#include <pybind11/pybind11.h>

namespace palpation::python {

void bind_mesh(pybind11::module_& module);
void bind_surface(pybind11::module_& module);
void bind_region(pybind11::module_& module);
void bind_readings(pybind11::module_& module);
void bind_phantom(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_plan(pybind11::module_& module);
void bind_conclusion(pybind11::module_& module);
void bind_exploration(pybind11::module_& module);
void bind_session_plan(pybind11::module_& module);
void bind_session(pybind11::module_& module);
void bind_robot(pybind11::module_& module);

}  // namespace palpation::python
