/// VTK's own poly data files, read without trust: counts are checked against the bytes first, and nothing is printed.
#pragma once

#include <vtkCellArray.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

#include "io/mesh_source.h"

namespace palpation {

/// What VTK makes of the file. Indices, sizes of arrays and numbers in it are still to be checked. Throws IoError with path and VTK's first
/// complaint.
vtkSmartPointer<vtkPolyData> read_poly_data(const MeshSource& source);

/// Throws IoError unless every array has a name and the given number of entries.
void check_arrays(const MeshSource& source, vtkFieldData* arrays, vtkIdType tuples, const std::string& where);

/// Cells as VTK stores them: cell i holds connectivity [offset i, offset i+1). Nothing of it may be trusted.
class VtpCells {
 public:
  /// Throws IoError if offsets decrease or point behind the connectivity.
  VtpCells(const MeshSource& source, vtkCellArray* cells, std::string name);

  vtkIdType count() const;
  vtkIdType size(vtkIdType cell) const;
  /// Throws IoError unless the index lies in [0, vertices).
  int corner(vtkIdType cell, vtkIdType i, std::size_t vertices) const;

 private:
  vtkIdType offset(vtkIdType cell) const;

  const MeshSource& source_;
  vtkDataArray* offsets_;
  vtkDataArray* connectivity_;
  std::string name_;
};

}  // namespace palpation
