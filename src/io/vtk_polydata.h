/// VTK's poly data as this project writes it. For sources of this folder alone: others have
/// vtp_shape.h.
#pragma once

#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>

#include "palpation/base/types.h"
#include "palpation/io/coordinates.h"

namespace palpation {

vtkSmartPointer<vtkPoints> vtk_points(vtkIdType count);
vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name, const Field& field);

/// Field data UNIT and FRAME, and SPACE where a patient's frame is known.
void tell_coordinates(vtkPolyData& polydata, LengthUnit unit, Frame frame);

/// Throws WriteError with path and reason.
void write_polydata(const std::filesystem::path& path, vtkPolyData& polydata);
/// The bytes that write_polydata would write. Throws WriteError naming `name`.
std::string bytes_of(const std::string& name, vtkPolyData& polydata);

}  // namespace palpation
