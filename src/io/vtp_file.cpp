#include "io/vtp_file.h"

#include <cmath>

#include "io/number_text.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

/// Numbers that follow each other may not decrease, which makes the last the largest.
std::vector<std::int64_t> ends_of(const MeshSource& source, VtpNumbers& numbers,
                                  const VtpCells& cells) {
  std::vector<std::int64_t> ends;
  numbers.each_integer(
      *cells.offsets, cells.count, "offsets of " + cells.kind, [&](std::int64_t end) {
        if (end < (ends.empty() ? 0 : ends.back())) {
          source.fail_at_byte(cells.offsets->place,
                              "offsets of " + cells.kind + " must not decrease, but that of cell " +
                                  std::to_string(ends.size()) + " is " + std::to_string(end));
        }
        ends.push_back(end);
      });
  return ends;
}

}  // namespace

VtpFile::VtpFile(const MeshSource& source)
    : source_(source),
      pieces_(read_vtp_structure(source, layout_, field_texts_)),
      numbers_(source, layout_) {
  for (const VtpPiece& piece : pieces_) check_arrays(piece);
}

void VtpFile::append_points(const VtpPiece& piece, std::vector<Vec3>& points) {
  if (piece.points == 0) return;
  numbers_.check_size(*piece.positions, 3 * piece.points, "points");
  points.reserve(points.size() + static_cast<std::size_t>(piece.points));
  Vec3 point;
  int component = 0;
  numbers_.each_real(*piece.positions, 3 * piece.points, "points", [&](double coordinate) {
    if (!std::isfinite(coordinate)) {
      source_.fail_at_byte(piece.positions->place, "vertex " + std::to_string(points.size()) +
                                                       ": " + "xyz"[component] + " = " +
                                                       text_of(coordinate) + " is not finite");
    }
    point[component++] = coordinate;
    if (component < 3) return;
    points.push_back(point);
    component = 0;
  });
}

void VtpFile::each_cell(const VtpPiece& piece, const VtpCells& cells,
                        const std::function<void(const std::vector<int>&)>& take) {
  if (cells.count == 0) return;
  const std::vector<std::int64_t> ends = ends_of(source_, numbers_, cells);
  std::size_t cell = 0;
  std::int64_t taken = 0;
  std::vector<int> corners;
  const auto pass_on = [&] {
    for (; cell < ends.size() && ends[cell] == taken; ++cell) {
      take(corners);
      corners.clear();
    }
  };
  pass_on();
  numbers_.each_integer(
      *cells.connectivity, ends.back(), "connectivity of " + cells.kind, [&](std::int64_t index) {
        if (index < 0 || index >= piece.points) {
          source_.fail_at_byte(cells.connectivity->place,
                               "cell " + std::to_string(cell) + " of " + cells.kind +
                                   ": vertex index " + std::to_string(index) +
                                   " is out of range 0 to " + std::to_string(piece.points - 1));
        }
        corners.push_back(static_cast<int>(index));
        ++taken;
        pass_on();
      });
}

void VtpFile::check_arrays(const VtpPiece& piece) {
  if (piece.points > 0 && !piece.positions)
    source_.fail_at_byte(
        piece.place,
        std::to_string(piece.points) + " points are announced, but there is no element <Points>");
  for (const VtpCells* cells : {&piece.verts, &piece.lines, &piece.strips, &piece.polys}) {
    if (cells->count > 0 && (!cells->offsets || !cells->connectivity)) {
      source_.fail_at_byte(cells->place, std::to_string(cells->count) + " " + cells->kind +
                                             " are announced, but <" + cells->kind +
                                             "> has no arrays \"connectivity\" and \"offsets\"");
    }
    if (cells->count == 0 && cells->offsets)
      numbers_.check(*cells->offsets, 0, "offsets of " + cells->kind);
    if (cells->count == 0 && cells->connectivity)
      numbers_.check(*cells->connectivity, 0, "connectivity of " + cells->kind);
  }
  const auto check = [&](const std::vector<VtpArray>& arrays, std::int64_t count,
                         const std::string& where) {
    for (const VtpArray& array : arrays) {
      if (array.name.empty())
        source_.fail_at_byte(array.place, "an array of the " + where + " has no name");
      const std::string name = "array " + in_quotes(array.name) + " of the " + where;
      if (array.components == 0) source_.fail_at_byte(array.place, name + " has no components");
      numbers_.check(array, array.components * count, name);
    }
  };
  check(piece.point_arrays, piece.points, "points");
  check(piece.cell_arrays, piece.cells(), "cells");
}

}  // namespace palpation
