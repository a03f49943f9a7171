// The module palpation._palpation: what palpation/__init__.py hands on.
#include <pybind11/pybind11.h>

#include "palpation/base/parallel.h"
#include "python/bindings.h"
#include "python/errors.h"

namespace py = pybind11;

PYBIND11_MODULE(_palpation, module) {
  using namespace palpation::python;
  module.doc() = "Where should a robot touch tissue next? See the package palpation.";
  const py::object own_name = module.attr("__name__");
  module.attr("__name__") = "palpation";  // classes are of the package, not of this file
  bind_errors(module);
  bind_mesh(module);
  bind_surface(module);
  bind_region(module);
  bind_readings(module);
  bind_phantom(module);
  bind_model(module);
  bind_plan(module);
  bind_conclusion(module);
  bind_exploration(module);
  bind_session(module);
  bind_robot(module);
  module.def("set_thread_count", &palpation::set_thread_count, py::arg("count"),
             "How many threads the library may use in this process; changes no result.");
  module.def("thread_count", &palpation::thread_count, "How many threads the library may use.");
  module.attr("__version__") = PALPATION_VERSION;
  module.attr("__name__") = own_name;
}
