/// Triangles from arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "palpation/geometry/surface.h"

namespace palpation::python {

/// Vertices in `unit` ("mm", "cm", "m"), n x 3, and faces, m x 3. Throws as arrays.h says.
TriangleMesh mesh_from(pybind11::handle vertices, pybind11::handle faces, const std::string& unit,
                       const char* function);

}  // namespace palpation::python
