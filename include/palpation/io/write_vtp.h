/// Files for ParaView and VTK: the tissue with its fields, the boundaries as closed lines, and a
/// list of steps to play.
///
/// Lengths are metres, numbers are doubles, nothing is rounded. The field data of every file say
/// so: texts UNIT ("m") and FRAME (coordinates.h). Files are written under a temporary name and
/// renamed. All functions throw WriteError with path and reason if that fails; the old file then
/// stays.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpation/base/types.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/coordinates.h"

namespace palpation {

/// What a curve on the tissue is; the numbers are those of the array `kind`.
enum class CurveKind {
  Estimate = 0,   ///< boundary of the tumour as believed
  Truth = 1,      ///< boundary of the true tumour
  BandInner = 2,  ///< inside of it lies tumour, as good as surely
  BandOuter = 3,  ///< outside of it lies healthy tissue, as good as surely
  Cut = 4,        ///< outside of it a place is tumour with a chosen risk at most
};

/// "estimate", "truth", "band_inner", "band_outer" or "cut": the text of the array `kind_name`.
std::string name_of(CurveKind kind);

/// A closed line in space; the first point is not repeated.
struct BoundaryCurve {
  std::vector<Vec3> points;  ///< metres
  CurveKind kind = CurveKind::Estimate;
  int part = 0;       ///< which part of the region it bounds, counted from 0 within its kind
  bool hole = false;  ///< an inner boundary of that part
};

/// The triangles of the surface, with one array at the points for each field. Throws InvalidInput
/// unless every field has one value a vertex and a name of its own.
void write_surface_vtp(const std::filesystem::path& path, const Surface& surface,
                       const std::vector<std::pair<std::string, Field>>& fields,
                       Frame frame = Frame::Mesh);

/// One closed polyline for each curve, with the cell arrays `kind` (int), `kind_name` (text),
/// `part` (int) and `hole` (int, 0 or 1). No curves make a valid file without lines. Throws
/// InvalidInput if a curve has fewer than two points, or a point outside the surface's bounding box
/// (widened by a millionth of its diameter).
void write_boundary_vtp(const std::filesystem::path& path, const Surface& surface,
                        std::span<const BoundaryCurve> curves, Frame frame = Frame::Mesh);

/// A ParaView collection: one file for each step, in order, at times 0, 1, 2, ... Names are
/// relative to the collection's folder.
void write_pvd(const std::filesystem::path& path, const std::vector<std::string>& files);

}  // namespace palpation
