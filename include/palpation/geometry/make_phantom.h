/// Curved phantoms: smooth sheets of which all is known in closed form, and meshes of them.
///
/// A sheet is a map from parameters (s, t), metres, to space. Every one is a topological disk whose
/// outside is up (+z) where it starts or is highest. Functions throw InvalidInput unless lengths
/// are positive and finite and the sheet stays clear of itself.
#pragma once

#include <functional>

#include "palpation/base/random.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

struct Sheet {
  Vec2 corner_m = Vec2::Zero();  ///< the parameters' rectangle starts here
  Vec2 size_m = Vec2::Zero();    ///< and is so large
  bool is_round = false;         ///< the parameters fill the disk in that square instead
  std::function<Vec3(const Vec2&)> position;
  std::function<Vec3(const Vec2&)> normal;  ///< outward, unit
  std::function<Vec2(const Vec2&)>
      unrolled;  ///< where developable: the plane that it unrolls to without stretching; else empty
};

/// A part of a cylinder about an axis along y: size_m.x along the arc, size_m.y along the axis, its
/// highest line x = size_m.x / 2, z = 0.
struct CylinderOptions {
  double radius_m = 0.015;
  Vec2 size_m = Vec2(0.025, 0.050);
};
Sheet cylinder_sheet(const CylinderOptions& options = {});

/// A spherical cap with its top at the origin: all within reach_m of it along the surface. Its
/// parameters keep distance and direction from the top. The default has the area of the paper's
/// phantom.
struct DomeOptions {
  double radius_m = 0.025;
  double reach_m = 0.0205;
};
Sheet dome_sheet(const DomeOptions& options = {});

/// z = (x^2 - y^2) / (2 radius_m) over a rectangle around the origin: curved with +-1/radius_m
/// there.
struct SaddleOptions {
  double radius_m = 0.025;
  Vec2 size_m = Vec2(0.025, 0.050);
};
Sheet saddle_sheet(const SaddleOptions& options = {});

/// z = amplitude_m sin(2 pi y / wavelength_m) over a rectangle from the origin.
struct WaveOptions {
  double amplitude_m = 0.002;
  double wavelength_m = 0.020;
  Vec2 size_m = Vec2(0.025, 0.050);
};
Sheet wave_sheet(const WaveOptions& options = {});

/// An S-bend: three flat flanks of flank_m by width_m one above the other, joined by half circles
/// of diameter gap_m, along x. Facing places of two flanks are gap_m apart in space and up to 2
/// flank_m + pi gap_m / 2 along the surface.
struct FoldedOptions {
  double gap_m = 0.0015;
  double flank_m = 0.020;
  double width_m = 0.025;
};
Sheet folded_sheet(const FoldedOptions& options = {});

/// A mesh of a sheet, its vertices on the true surface.
struct PhantomMesh {
  TriangleMesh mesh;
  Points2 parameters;  ///< (s, t) of every vertex
};

/// edge_m: about how long edges are in the parameters. Inner vertices move at random by up to
/// `jitter` of that each way (half of that towards the middle of a round sheet), border vertices
/// along the border; of each cell's two diagonals the one between the more even triangles is taken:
/// the mesh is irregular. Throws InvalidInput unless edge_m is positive and finite and leaves at
/// least one cell and at most 2^27 vertices, jitter in [0, 0.45].
PhantomMesh make_phantom(const Sheet& sheet, double edge_m, double jitter, Random& random);

}  // namespace palpation
