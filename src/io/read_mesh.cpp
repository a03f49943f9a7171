#include "palpation/io/read_mesh.h"

#include <algorithm>
#include <array>
#include <optional>

#include "io/length_scale.h"
#include "io/mesh_text.h"
#include "io/polygon_soup.h"
#include "io/soup_repairs.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr double kSmallestTissue = 1e-3;
constexpr double kLargestTissue = 2.0;

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return bytes.substr(0, kMark.size()) == kMark ? bytes.substr(kMark.size()) : bytes;
}

/// No format begins with more than that.
constexpr std::size_t kLongestPreamble = 1 << 16;

/// The first word that is not in a comment.
std::string_view first_word(std::string_view bytes) {
  LineCursor lines(bytes.substr(0, kLongestPreamble));
  std::vector<std::string_view> words;
  while (const std::optional<std::string_view> line = lines.next()) {
    split_words(without_comment(*line), words);
    if (!words.empty()) return words[0];
  }
  return {};
}

bool is_off_header(std::string_view word) {
  constexpr std::array<std::string_view, 13> kHeaders = {
      "OFF",    "COFF",    "NOFF", "CNOFF", "NCOFF", "STOFF", "STCOFF",
      "STNOFF", "STCNOFF", "4OFF", "nOFF",  "4nOFF", "C4OFF"};
  return std::find(kHeaders.begin(), kHeaders.end(), word) != kHeaders.end();
}

bool begins_like_obj(std::string_view word) {
  constexpr std::array<std::string_view, 14> kWords = {
      "v", "vt", "vn", "vp", "f", "fo", "g", "o", "s", "l", "p", "mtllib", "usemtl", "mg"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

enum class Format { Obj, Off, AsciiStl, BinaryStl, Ply, Vtp };

/// "ply" by itself on the first line.
bool begins_like_ply(std::string_view bytes) {
  bytes = bytes.substr(0, kLongestPreamble);
  const std::string_view line =
      bytes.substr(0, std::min(bytes.find_first_of("\r\n"), bytes.size()));
  return line.substr(0, 3) == "ply" && line.find_first_not_of(" \t", 3) == std::string_view::npos;
}

/// What other files say at their beginning, that the reason is told and not its consequence.
void refuse_other_kinds(const MeshSource& source) {
  const auto begins = [&](std::string_view mark) {
    return source.bytes.substr(0, mark.size()) == mark;
  };
  if (begins("\x1F\x8B") || begins("PK\3\4") || begins("BZh") ||
      begins("\xFD"
             "7zXZ"))
    source.fail_at_byte(0, "the file is compressed: unpack it first");
  if (begins("\xFF\xFE") || begins("\xFE\xFF"))
    source.fail_at_byte(0, "the file is text in UTF-16: save it as UTF-8 or ASCII");
  if (begins("# vtk DataFile"))
    source.fail_at_line(1, "VTK's legacy format is not read: write it as VTP or PLY");
}

/// Recognizes the format by content. Binary STL has no mark but its size, and may begin with
/// "solid" like its ASCII cousin.
Format format_of(const MeshSource& source) {
  const std::string_view bytes = source.bytes;
  const std::string_view word = first_word(bytes);
  if (begins_like_ply(bytes)) return Format::Ply;
  if (has_size_of_binary_stl(bytes)) return Format::BinaryStl;
  refuse_other_kinds(source);
  // A binary STL cut short has NUL bytes in its title or count.
  if (lower_case(word) == "solid")
    return bytes.substr(0, 84).find('\0') == std::string_view::npos ? Format::AsciiStl
                                                                    : Format::BinaryStl;
  if (is_off_header(word)) return Format::Off;
  if (!word.empty() && word[0] == '<') return Format::Vtp;
  if (begins_like_obj(word)) return Format::Obj;
  const std::string extension = lower_case(source.path.extension().string());
  if (extension == ".stl") return Format::BinaryStl;
  if (extension == ".obj") return Format::Obj;
  source.fail("its content is none of OBJ, OFF, STL, PLY and VTP");
}

PolygonSoup read_soup(const MeshSource& source) {
  switch (format_of(source)) {
    case Format::Obj:
      return read_obj(source);
    case Format::Off:
      return read_off(source);
    case Format::AsciiStl:
      return read_ascii_stl(source);
    case Format::BinaryStl:
      return read_binary_stl(source);
    case Format::Ply:
      return read_ply(source);
    case Format::Vtp:
      return read_vtp(source);
  }
  source.fail("its content is none of OBJ, OFF, STL, PLY and VTP");
}

void warn_of_extension(const MeshSource& source, PolygonSoup& soup) {
  const std::string extension = lower_case(source.path.extension().string());
  constexpr std::array<std::string_view, 5> kExtensions = {".obj", ".off", ".stl", ".ply", ".vtp"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) return;
  if (lower_case(soup.format).find(extension.substr(1)) != std::string::npos) return;
  soup.warn("The file is named " + extension + " but holds " + soup.format +
                ": it was read as what it holds.",
            "Rename it: other programs may go by the name.");
}

TriangleMesh in_metres(const PolygonSoup& soup, const std::vector<SoupTriangle>& triangles,
                       LengthUnit unit) {
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(soup.points.size()), 3);
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    mesh.vertices.row(static_cast<Eigen::Index>(i)) =
        soup.points[i].unaryExpr([unit](double value) { return to_metres(value, unit); });
  }
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i)
      mesh.triangles(static_cast<Eigen::Index>(t), i) =
          triangles[t].corners[static_cast<std::size_t>(i)];
  }
  return mesh;
}

MeshFile assembled(const MeshSource& source, LengthUnit unit, const MeshRepair& repair) {
  PolygonSoup soup = read_soup(source);
  if (soup.points.empty()) source.fail("the " + soup.format + " holds no vertices");
  if (soup.face_count() == 0) source.fail("the " + soup.format + " holds no faces");
  warn_of_extension(source, soup);
  if (soup.told.unit && *soup.told.unit != unit)
    source.fail("its field data say that its lengths are in " +
                std::string(name_of(*soup.told.unit)) + " (UNIT), but it is to be read in " +
                name_of(unit) + ": give the file's own unit");
  if (repair.weld_equal_vertices) {
    const std::int64_t welded = weld_equal_points(soup);
    if (welded > 0)
      soup.warn(std::to_string(welded) + " vertices were joined with another at the same place.",
                "As was asked for.");
  }
  refuse_crowds(source, soup);
  std::vector<SoupTriangle> triangles = triangles_of(source, soup, repair);
  if (repair.drop_duplicates) drop_duplicates(soup, triangles);
  if (repair.drop_flat) drop_flat(soup, triangles, unit);
  if (triangles.empty()) source.fail("no face has an area: nothing is left of the " + soup.format);
  refuse_duplicates(source, soup, triangles);
  if (repair.keep_largest) keep_largest(soup, triangles);
  orient_alike(triangles, soup);
  const std::int64_t unused = drop_unused_points(soup, triangles);
  if (unused > 0) {
    soup.warn(std::to_string(unused) + " vertices belong to no face and were dropped.",
              "Harmless, unless faces are missing. Vertices are counted without them.");
  }
  const std::int64_t equal = warn_of_close_points(soup);
  warn_of_slivers(soup, triangles);
  Field height_sd =
      Eigen::Map<Field>(soup.height_sd.data(), static_cast<Eigen::Index>(soup.height_sd.size()))
          .unaryExpr([unit](double value) { return to_metres(value, unit); });
  return {in_metres(soup, triangles, unit),
          std::move(soup.warnings),
          std::move(soup.format),
          std::move(height_sd),
          equal,
          soup.told.frame.value_or(Frame::Mesh)};
}

/// The units under which the size would be that of tissue, as a question.
std::string suggestion(double extent_m_as_read, LengthUnit unit) {
  const double extent = extent_m_as_read * units_per_metre(unit);
  std::string names;
  for (const LengthUnit other :
       {LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre}) {
    const double size_m = extent / units_per_metre(other);
    if (size_m >= kSmallestTissue && size_m <= kLargestTissue)
      names += (names.empty() ? "" : " or ") + std::string(name_of(other));
  }
  return names.empty() ? "no known unit makes it so" : "is its unit " + names + "?";
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path, LengthUnit unit, const MeshRepair& repair) {
  MeshFile file = read_mesh_of_any_size(path, unit, repair);
  const double size_m = extent_m(file.mesh);
  if (size_m >= kSmallestTissue && size_m <= kLargestTissue) return file;
  throw IoError(path.string() + ": read in " + std::string(name_of(unit)) + " the mesh is " +
                text_of(size_m) + " m long, but tissue is between 0.001 m and 2 m across; " +
                suggestion(size_m, unit));
}

MeshFile read_mesh_of_any_size(const std::filesystem::path& path, LengthUnit unit,
                               const MeshRepair& repair) {
  const std::string bytes = read_file(path);
  // To the count in a binary STL every byte matters.
  const std::string_view content =
      has_size_of_binary_stl(bytes) ? bytes : without_byte_order_mark(bytes);
  const MeshSource source{path, content, bytes.size() - content.size()};
  if (source.bytes.empty()) source.fail("the file is empty: no vertices");
  return assembled(source, unit, repair);
}

}  // namespace palpation
