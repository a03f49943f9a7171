#include "palpation/io/read_boundary.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/join_lines.h"
#include "io/landing.h"
#include "io/length_scale.h"
#include "io/mesh_source.h"
#include "io/number_text.h"
#include "io/vtp_file.h"
#include "io/vtp_told.h"
#include "palpation/base/error.h"
#include "palpation/geometry/chart_place.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr double kFarthestBeside_m = 0.005;
const std::string kEstimate = "estimate";

/// The kind of every cell, or nothing where the file does not tell.
std::vector<std::string> kinds_of(VtpFile& file, const VtpPiece& piece) {
  for (const VtpArray& array : piece.cell_arrays) {
    if (array.name == "kind_name")
      return file.numbers().texts(array, piece.cells(), "array \"kind_name\" of the cells");
  }
  return {};
}

Region region_of(const MeshSource& source, const std::vector<Ring>& rings) {
  try {
    return Region::even_odd(rings);
  } catch (const InvalidInput& error) {
    source.fail(error.what());
  }
}

/// The lines of a file that are of the estimate, and the points that they run through.
struct Lines {
  std::vector<Vec3> points;
  std::vector<Line> lines;
  std::set<std::string> other_kinds;
};

Lines lines_of(const MeshSource& source) {
  VtpFile file(source);
  Lines made;
  for (const VtpPiece& piece : file.pieces()) {
    if (piece.lines.count == 0 && piece.cells() > 0)
      source.fail("holds no lines, so it is no boundary");
    const std::vector<std::string> kinds = kinds_of(file, piece);
    const auto first = static_cast<int>(made.points.size());
    file.append_points(piece, made.points);
    // Cells are counted kind by kind, points before lines.
    auto cell = static_cast<std::size_t>(piece.verts.count);
    file.each_cell(piece, piece.lines, [&](const std::vector<int>& corners) {
      const std::string kind = kinds.empty() ? kEstimate : kinds[cell++];
      if (kind != kEstimate) {
        made.other_kinds.insert(kind);
        return;
      }
      Line& line = made.lines.emplace_back();
      for (const int corner : corners) line.push_back(first + corner);
    });
  }
  const LengthUnit unit = told_coordinates(source, file).unit.value_or(LengthUnit::Metre);
  for (Vec3& point : made.points)
    point = point.unaryExpr([unit](double value) { return to_metres(value, unit); });
  return made;
}

}  // namespace

BoundaryFile read_boundary_vtp(const std::filesystem::path& path, const Surface& surface) {
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes};
  const Lines found = lines_of(source);
  Landing landing(surface, kFarthestBeside_m);
  std::vector<Ring> rings;
  std::size_t points_read = 0;
  for (const Line& line : joined_lines(source, found.points, found.lines)) {
    Ring& ring = rings.emplace_back();
    for (const int point : line) {
      std::string fault;
      const std::optional<SurfacePoint> place = landing.place(found.points[point], fault);
      if (!place) source.fail("point " + std::to_string(point) + " of the boundary: " + fault);
      ring.push_back(chart_place(surface, *place));
    }
    points_read += ring.size();
  }
  BoundaryFile boundary{region_of(source, rings), {}};
  if (!rings.empty() && boundary.region.empty())
    source.fail("no area is inside its " + std::to_string(rings.size()) + " closed lines");
  if (rings.empty() && !found.other_kinds.empty()) {
    boundary.warnings.push_back(path.string() + ": no line is of the kind \"" + kEstimate +
                                "\", only of \"" + *found.other_kinds.begin() +
                                "\": taken for a boundary around nothing.");
  }
  if (landing.moved() > 0) {
    boundary.warnings.push_back(
        path.string() + ": " + std::to_string(landing.moved()) + " of " +
        std::to_string(points_read) + " points of the boundary lay off the surface, by up to " +
        length_text(landing.farthest_m()) + " m, and were taken to its closest points.");
  }
  return boundary;
}

}  // namespace palpation
