#include "io/point_cloud.h"

#include <algorithm>

#include "io/length_scale.h"
#include "io/mesh_text.h"
#include "io/polygon_soup.h"

namespace palpation {
namespace {

LengthUnit needed_unit(const MeshSource& source, const ContactColumns& columns) {
  if (!columns.unit) source.fail("its unit is not in the file: say mm, cm or m");
  return *columns.unit;
}

}  // namespace

ContactsFile read_xyz(const MeshSource& source, const ContactColumns& columns) {
  const LengthUnit unit = needed_unit(source, columns);
  source.refuse_nul_bytes();
  ContactsFile file;
  std::vector<Vec3> points, outward;
  LineCursor lines(source.bytes);
  CoordinateReader coordinates(source);
  std::vector<std::string_view> words;
  while (const std::optional<std::string_view> line = lines.next()) {
    split_words(without_comment(*line), words, 7);
    if (words.empty()) continue;
    if (words.size() < 3) source.fail_at_line(lines.line(), "three numbers are expected");
    const auto number = static_cast<std::int64_t>(points.size());
    const auto vector = [&](std::size_t first) {
      return coordinates.point(std::span(words).subspan(first).first<3>(), number, lines.line());
    };
    points.push_back(vector(0));
    if (words.size() >= 6) outward.push_back(vector(3));
    file.places.push_back(static_cast<int>(lines.line()));
  }
  file.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    file.points.row(static_cast<Eigen::Index>(i)) =
        points[i].unaryExpr([unit](double value) { return to_metres(value, unit); });
  const bool tells = outward.size() == points.size() &&
                     std::none_of(outward.begin(), outward.end(),
                                  [](const Vec3& each) { return each.isZero(0.0); });
  if (tells) {
    file.outward.resize(file.points.rows(), 3);
    for (std::size_t i = 0; i < outward.size(); ++i)
      file.outward.row(static_cast<Eigen::Index>(i)) = outward[i].stableNormalized();
    file.outward_from = "the normals in the file";
  }
  file.unit_words = "the unit that was asked for";
  return file;
}

ContactsFile read_ply_cloud(const MeshSource& source, const ContactColumns& columns) {
  const LengthUnit unit = needed_unit(source, columns);
  const PolygonSoup soup = read_ply(source);
  ContactsFile file;
  file.points.resize(static_cast<Eigen::Index>(soup.points.size()), 3);
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    file.points.row(static_cast<Eigen::Index>(i)) =
        soup.points[i].unaryExpr([unit](double value) { return to_metres(value, unit); });
    file.places.push_back(static_cast<int>(i));
  }
  file.place_word = "vertex";
  file.unit_words = "the unit that was asked for";
  return file;
}

}  // namespace palpation
