/// Meshes from files: OBJ, OFF, STL (ASCII and binary), PLY (ASCII and binary, both byte orders)
/// and VTP, recognized by content.
///
/// Time and memory are bounded by the bytes of the file; no locale, no printing, no other file is
/// opened. Coordinates are read in double precision. Polygons are cut into fans. STL corners with
/// equal bits are one vertex: that is the format. Every repair is a warning of the result: unused
/// vertices dropped, faces turned round to agree with their neighbours, corners welded on request.
/// A file that was cut short is an error, but for OBJ between two lines: it has no counts. Where a
/// comment at its top tells them (as write_mesh writes it), they are compared.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "palpation/geometry/triangle_mesh.h"
#include "palpation/io/coordinates.h"

namespace palpation {

/// What was repaired or looks odd in a file.
struct MeshWarning {
  std::string text;    ///< one plain sentence
  std::string advice;  ///< what it means and what to do, for a person
};

struct MeshFile {
  TriangleMesh mesh;  ///< metres
  std::vector<MeshWarning> warnings;
  std::string format;  ///< "OBJ", "binary PLY", ...
  Field height_sd{};   ///< of each vertex along the normal, metres, where a PLY has that property:
                       ///< how sure its surface is (belief/height.h); else empty
  std::int64_t equal_vertices = 0;  ///< at the same place as another: MeshRepair would join them
  Frame frame = Frame::Mesh;        ///< what the field data of a VTP say
};

/// What is repaired only on request, in this order. Each that was done is a warning of the result,
/// with how many elements it took and where the first of them lies.
struct MeshRepair {
  /// Vertices with equal coordinates become one; STL corners always do.
  bool weld_equal_vertices = false;
  /// Polygons are cut also where none of their corners sees them as a whole, which is refused else.
  bool cut_polygons = false;
  /// Of triangles with the same corners, in whatever order, the first is kept.
  bool drop_duplicates = false;
  /// Corners that follow themselves count once, and what has no area (as Surface measures it) goes.
  /// A triangle whose middle corner lies on its longest side leaves no crack: its neighbour there
  /// is cut at that corner. Where two corners are in one place a seam is left, unless welded.
  bool drop_flat = false;
  /// Of the parts that hang together by edges the one of the largest area is kept.
  bool keep_largest = false;
};

/// Reads and validates syntax, counts, indices and numbers, then the size: tissue is between 1 mm
/// and 2 m across. Topology is left to Surface. Polygons have at most 256 corners, and more than
/// 250,000 triangles at least one vertex for three of them. Numbers that follow the coordinates of
/// a vertex (weight, colour, normal) are ignored, as are other properties and arrays once their
/// lengths agree, but for what the field data of a VTP say of its coordinates: one that says
/// another unit is refused. Throws IoError with path, line or byte, element, value and rule.
MeshFile read_mesh(const std::filesystem::path& path, LengthUnit unit,
                   const MeshRepair& repair = {});

/// The same without the check of the size, for tools that only describe a file.
MeshFile read_mesh_of_any_size(const std::filesystem::path& path, LengthUnit unit,
                               const MeshRepair& repair = {});

/// Writes PLY (binary little-endian), OBJ, OFF or STL (binary), by the path's extension,
/// coordinates in the unit. What read_mesh gave comes back as the same doubles in the same unit,
/// but from STL, which holds floats. Throws InvalidInput for another extension, a vertex that is
/// not finite or a triangle that points at none; WriteError if the file cannot be written.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit);

/// The same as PLY, with the vertex property height_sd in the same unit, and comments that say so.
/// Throws InvalidInput also unless the path ends with .ply and height_sd has a number that is not
/// negative for each vertex.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, LengthUnit unit,
                const Field& height_sd);

}  // namespace palpation
