#include "io/polygon_soup.h"
#include "io/vtp_file.h"

namespace palpation {
namespace {

/// The corners of a cell, which its piece counts from 0 and the file from `first`.
void append_face(const MeshSource& source, const std::vector<int>& corners, int first,
                 PolygonSoup& soup) {
  soup.begin_face(0);
  for (const int corner : corners) soup.corners.push_back(first + corner);
  soup.end_face(source);
}

/// Every other triangle of a strip runs the other way.
void append_strip(const MeshSource& source, const std::vector<int>& corners, int first,
                  PolygonSoup& soup) {
  if (corners.size() < 3)
    source.fail("a strip of " + std::to_string(corners.size()) + " corners; it has at least 3");
  for (std::size_t i = 0; i + 2 < corners.size(); ++i)
    append_face(source, {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]}, first, soup);
}

}  // namespace

PolygonSoup read_vtp(const MeshSource& source) {
  VtpFile file(source);
  PolygonSoup soup;
  soup.format = "VTP";
  soup.told = told_coordinates(source, file);
  for (const std::string& words : soup.told.not_understood)
    soup.warn("Its field data say " + words + ", which is not understood.",
              "Known are UNIT mm, cm or m, and FRAME or SPACE RAS or LPS.");
  std::int64_t others = 0;
  for (const VtpPiece& piece : file.pieces()) {
    const auto first = static_cast<std::int64_t>(soup.points.size());
    if (first + piece.points > kMostPoints)
      source.fail_at_byte(piece.place,
                          "more than " + std::to_string(kMostPoints) + " points in all");
    file.append_points(piece, soup.points);
    const auto with = [&](auto append) {
      return [&source, &soup, first, append](const std::vector<int>& corners) {
        append(source, corners, static_cast<int>(first), soup);
      };
    };
    file.each_cell(piece, piece.polys, with(append_face));
    file.each_cell(piece, piece.strips, with(append_strip));
    others += piece.verts.count + piece.lines.count;
  }
  soup.warn_of_underflows(file.numbers().underflows());
  if (others > 0)
    soup.warn(std::to_string(others) + " cells are points or lines and were left out.", kFacesOnly);
  return soup;
}

}  // namespace palpation
