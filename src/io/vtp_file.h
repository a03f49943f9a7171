/// VTK's own poly data files (VTP), read without trust: the structure of the file is checked
/// against its counts before a number is read.
///
/// What VTK's parser takes in silence is refused: a count of cells or points that the arrays do not
/// have, arrays of points and cells that are too short, too long, or without a name.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_array.h"
#include "io/vtp_structure.h"
#include "palpation/base/types.h"

namespace palpation {

class VtpFile {
 public:
  /// Reads the structure and looks whether all arrays of points and cells hold what the counts
  /// promise. Throws IoError.
  explicit VtpFile(const MeshSource& source);

  VtpFile(const VtpFile&) = delete;
  VtpFile& operator=(const VtpFile&) = delete;

  const std::vector<VtpPiece>& pieces() const { return pieces_; }
  /// Of the field data, those arrays that hold one text each.
  const std::vector<VtpArray>& field_texts() const { return field_texts_; }
  VtpNumbers& numbers() { return numbers_; }

  /// Appends the finite positions of a piece's points. Throws IoError.
  void append_points(const VtpPiece& piece, std::vector<Vec3>& points);
  /// Calls for each cell with its corners, all in [0, points of the piece). Throws IoError.
  void each_cell(const VtpPiece& piece, const VtpCells& cells,
                 const std::function<void(const std::vector<int>&)>& take);

 private:
  void check_arrays(const VtpPiece& piece);

  const MeshSource& source_;
  VtpLayout layout_;
  std::vector<VtpArray> field_texts_;
  std::vector<VtpPiece> pieces_;
  VtpNumbers numbers_;
};

}  // namespace palpation
