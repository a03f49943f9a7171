/// What a mesh file says, before anything is made of it: points and polygons, each with its place
/// in the file.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_told.h"
#include "palpation/base/types.h"
#include "palpation/io/read_mesh.h"

namespace palpation {

enum class PlaceKind { Line, Byte, None };

/// A polygon with more corners than this is refused.
inline constexpr int kMostCorners = 256;
/// Three times the triangles must be countable in an int, as must the vertices.
inline constexpr std::int64_t kMostPoints = std::numeric_limits<int>::max() / 3 * 3;

struct PolygonSoup {
  std::string format;
  std::vector<Vec3> points;       ///< in the file's unit, finite
  std::vector<double> height_sd;  ///< of each point, in the same unit; or none
  std::vector<MeshWarning> warnings;
  ToldCoordinates told;  ///< of a VTP
  PlaceKind place_kind = PlaceKind::None;
  int first_number = 0;  ///< what the format calls its first vertex and face: 0 or 1

  std::vector<int>
      corners;  ///< of all faces in turn, counted from 0; not checked until `triangles_of`
  std::vector<std::int64_t> first_corner;  ///< of each face
  std::vector<std::int64_t> places;        ///< of each face: its line or byte; empty if unknown

  std::size_t face_count() const { return first_corner.size(); }
  std::span<const int> face(std::size_t index) const;
  /// Starts a face; its corners are pushed next.
  void begin_face(std::int64_t place);
  /// Throws IoError if the face begun last has fewer than three corners or more than kMostCorners.
  void end_face(const MeshSource& source) const;
  void warn(std::string text, std::string advice) {
    warnings.push_back({std::move(text), std::move(advice)});
  }
  /// Says how many numbers became 0, if any did.
  void warn_of_underflows(std::int64_t count);
  [[noreturn]] void fail_at_face(const MeshSource& source, std::size_t face,
                                 const std::string& what) const;
};

/// Private readers, one for each format. Each throws IoError for what breaks the format's syntax or
/// counts.
PolygonSoup read_obj(const MeshSource& source);
PolygonSoup read_off(const MeshSource& source);
PolygonSoup read_ascii_stl(const MeshSource& source);
PolygonSoup read_binary_stl(const MeshSource& source);
PolygonSoup read_ply(const MeshSource& source);
PolygonSoup read_vtp(const MeshSource& source);

/// True if the size is what the count in a binary STL's header asks for.
bool has_size_of_binary_stl(std::string_view bytes);

/// Advice that several readers give.
inline constexpr const char* kFacesOnly = "Harmless if the tissue is made of faces.";
inline constexpr const char* kFreshCopy =
    "Look whether faces are missing. If so, copy or export the file again.";

/// One triangle of a face.
struct SoupTriangle {
  std::array<int, 3> corners;
  int face;
};

/// Throws IoError if the faces make far more triangles than the vertices that they use: no surface
/// has that, and what is done with triangles takes memory for each, not for each byte of the file.
void refuse_crowds(const MeshSource& source, const PolygonSoup& soup);

/// All faces as fans of triangles, after the check of every corner. Throws IoError for a corner out
/// of range or used twice, and for a polygon that none of its corners sees as a whole: its fan
/// would overlap itself. Asked for, such a polygon is cut otherwise, corners that follow themselves
/// count once and faces without three of them go, with a warning.
std::vector<SoupTriangle> triangles_of(const MeshSource& source, PolygonSoup& soup,
                                       const MeshRepair& repair = {});

/// Throws IoError if two triangles have the same three corners.
void refuse_duplicates(const MeshSource& source, const PolygonSoup& soup,
                       const std::vector<SoupTriangle>& triangles);

/// Turns triangles round until neighbours agree, the fewest in each component; a component that no
/// turning mends stays as it is. Warns of that, and of more components than one.
void orient_alike(std::vector<SoupTriangle>& triangles, PolygonSoup& soup);

/// Gives points with equal coordinates (0 and -0 are equal) the number of the first of them, and
/// drops the others. Returns how many were dropped.
std::int64_t weld_equal_points(PolygonSoup& soup);

/// Drops the points that no triangle uses, renumbering; returns how many.
std::int64_t drop_unused_points(PolygonSoup& soup, std::vector<SoupTriangle>& triangles);

/// Warns of points that are equal, or closer to each other than 1e-12 of the extent. Returns how
/// many are equal to another.
std::int64_t warn_of_close_points(PolygonSoup& soup);

/// Warns of triangles with an angle below 1e-6 rad: their longest side is more than a million times
/// their height.
void warn_of_slivers(PolygonSoup& soup, const std::vector<SoupTriangle>& triangles);

}  // namespace palpation
