#include "palpation/io/read_boundary.h"

#include <string>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_file.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr double kFarthest_m = 0.005;

Vec2 chart_place(const MeshSource& source, const Surface& surface, const Vec3& position) {
  const SurfacePoint point = surface.project(position);
  const double distance = (surface.position(point) - position).norm();
  require(distance <= kFarthest_m, source.path.string(), "a point " + text_of(distance) + " m from the tissue",
          "is no boundary on it: it may lie up to 5 mm away");
  Vec2 place = Vec2::Zero();
  for (int corner = 0; corner < 3; ++corner)
    place += point.barycentric[corner] * surface.chart().uv.row(surface.triangle(point.face)[corner]).transpose();
  return place;
}

/// The kind of every cell, or nothing where the file does not tell.
std::vector<std::string> kinds_of(VtpFile& file, const VtpPiece& piece) {
  for (const VtpArray& array : piece.cell_arrays) {
    if (array.name == "kind_name") return file.numbers().texts(array, piece.cells(), "array \"kind_name\" of the cells");
  }
  return {};
}

}  // namespace

Region read_boundary_vtp(const std::filesystem::path& path, const Surface& surface) {
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes};
  VtpFile file(source);
  std::vector<Ring> rings;
  for (const VtpPiece& piece : file.pieces()) {
    if (piece.lines.count == 0 && piece.cells() > 0) source.fail("holds no lines, so it is no boundary");
    const std::vector<std::string> kinds = kinds_of(file, piece);
    std::vector<Vec3> points;
    file.append_points(piece, points);
    // Cells are counted kind by kind, points before lines.
    auto cell = static_cast<std::size_t>(piece.verts.count);
    file.each_cell(piece, piece.lines, [&](const std::vector<int>& corners) {
      if (!kinds.empty() && kinds[cell++] != "estimate") return;
      Ring ring;
      for (const int corner : corners) ring.push_back(chart_place(source, surface, points[static_cast<std::size_t>(corner)]));
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      rings.push_back(std::move(ring));
    });
  }
  return Region::even_odd(rings);
}

}  // namespace palpation
