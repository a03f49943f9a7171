/// The structure of a VTP file: its pieces, and what their arrays say of themselves, before a
/// number is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_array.h"

namespace palpation {

/// Cells of one kind: cell i has the corners [ends[i-1], ends[i]) of the connectivity.
struct VtpCells {
  std::string kind;  ///< "Verts", "Lines", "Strips" or "Polys"
  std::int64_t count = 0;
  std::optional<VtpArray> connectivity, offsets;
  std::size_t place = 0;  ///< byte of the tag that tells the count
};

struct VtpPiece {
  std::int64_t points = 0;
  std::optional<VtpArray> positions;
  VtpCells verts, lines, strips, polys;
  std::vector<VtpArray> point_arrays, cell_arrays;
  std::size_t place = 0;

  std::int64_t cells() const { return verts.count + lines.count + strips.count + polys.count; }
};

/// Walks through the elements of a file. Notes in `layout` how its numbers are written, and in
/// `field_texts` the arrays of the field data that say they hold one text. Throws IoError naming
/// the byte.
std::vector<VtpPiece> read_vtp_structure(const MeshSource& source, VtpLayout& layout,
                                         std::vector<VtpArray>& field_texts);

}  // namespace palpation
