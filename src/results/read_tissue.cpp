// surface.vtp and boundary.vtp, by the reader that trusts no file.
#include "io/length_scale.h"
#include "io/vtp_file.h"
#include "io/vtp_told.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "results/run.h"

namespace palpation::results {
namespace {

namespace fs = std::filesystem;

/// Files of this project have one piece, and so do those that other programs save of them.
const VtpPiece& only_piece(const MeshSource& source, const VtpFile& file) {
  if (file.pieces().size() != 1)
    source.fail("has " + std::to_string(file.pieces().size()) + " pieces, where one is expected");
  return file.pieces().front();
}

std::vector<Vec3> points_of(VtpFile& file, const VtpPiece& piece, LengthUnit unit) {
  std::vector<Vec3> points;
  file.append_points(piece, points);
  for (Vec3& point : points)
    point = point.unaryExpr([unit](double value) { return to_metres(value, unit); });
  return points;
}

Field numbers_of(VtpFile& file, const VtpArray& array, std::int64_t count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count));
  file.numbers().each_real(array, count, array.name,
                           [&](double value) { values.push_back(value); });
  return Eigen::Map<Field>(values.data(), static_cast<Eigen::Index>(values.size()));
}

bool is_real(const VtpArray& array) {
  return array.components == 1 &&
         (array.type == VtpType::Float64 || array.type == VtpType::Float32);
}

}  // namespace

const Field* Tissue::field(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? nullptr : &found->second;
}

Tissue read_tissue(const fs::path& path) {
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes};
  VtpFile file(source);
  const VtpPiece& piece = only_piece(source, file);
  const ToldCoordinates told = told_coordinates(source, file);
  Tissue tissue;
  tissue.frame = told.frame;
  const std::vector<Vec3> points = points_of(file, piece, told.unit.value_or(LengthUnit::Metre));
  tissue.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    tissue.mesh.vertices.row(static_cast<Eigen::Index>(i)) = points[i];
  tissue.mesh.triangles.resize(static_cast<Eigen::Index>(piece.polys.count), 3);
  Eigen::Index face = 0;
  file.each_cell(piece, piece.polys, [&](const std::vector<int>& corners) {
    if (corners.size() != 3) source.fail("cell " + std::to_string(face) + " is no triangle");
    tissue.mesh.triangles.row(face++) << corners[0], corners[1], corners[2];
  });
  if (face == 0) source.fail("holds no triangles, so it is no tissue");
  for (const VtpArray& array : piece.point_arrays)
    if (is_real(array)) tissue.fields[array.name] = numbers_of(file, array, piece.points);
  return tissue;
}

std::vector<Curve> read_curves(const fs::path& path) {
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes};
  VtpFile file(source);
  const VtpPiece& piece = only_piece(source, file);
  const std::vector<Vec3> points =
      points_of(file, piece, told_coordinates(source, file).unit.value_or(LengthUnit::Metre));
  std::vector<Curve> curves(static_cast<std::size_t>(piece.lines.count));
  std::size_t line = 0;
  file.each_cell(piece, piece.lines, [&](const std::vector<int>& corners) {
    for (const int corner : corners) curves[line].points.push_back(points[corner]);
    if (corners.size() > 1 && corners.front() == corners.back()) curves[line].points.pop_back();
    ++line;
  });
  if (piece.cells() != piece.lines.count) source.fail("holds other cells than lines");
  for (const VtpArray& array : piece.cell_arrays) {
    if (array.name == "kind_name") {
      const std::vector<std::string> kinds =
          file.numbers().texts(array, piece.cells(), "array \"kind_name\" of the cells");
      for (std::size_t i = 0; i < curves.size(); ++i) curves[i].kind = kinds[i];
    }
    if (array.name != "part" && array.name != "hole") continue;
    line = 0;
    file.numbers().each_integer(array, piece.cells(), array.name, [&](std::int64_t value) {
      if (array.name == "part") curves[line].part = static_cast<int>(value);
      if (array.name == "hole") curves[line].is_hole = value != 0;
      ++line;
    });
  }
  return curves;
}

}  // namespace palpation::results
