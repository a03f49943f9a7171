/// Exact shortest paths along a triangle mesh, as far as they are asked for.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// A straight piece of a way inside one face.
struct Piece {
  int face;
  Vec3 from, to;  // barycentric
};

struct UnfoldingLimits {
  double radius_m = std::numeric_limits<double>::infinity();  ///< nothing farther is looked at
};

/// From every vertex to the nearest source; infinite where none can be reached, or none within the
/// radius. By unfolding sequences of faces, windows that cannot hold a shortest path left out (Chen
/// and Han 1990, Xin and Wang 2009). The work is for what is within the radius.
Field unfolded_distances(const Surface& surface, std::span<const SurfacePoint> sources,
                         const UnfoldingLimits& limits = {});

/// The same from some vertices to one source: nothing is touched but what is within the radius.
std::vector<double> unfolded_distances_of(const Surface& surface, const SurfacePoint& source,
                                          std::span<const int> vertices, double radius_m);

struct ShortestPath {
  double length_m = 0.0;
  std::vector<Piece> pieces;  ///< from the start to the end
};

/// The shortest path between two places; nothing where no way leads there. at_most_m: the length of
/// a way that is known; only what could be on a shorter one is looked at, and nothing is found if
/// there is none.
std::optional<ShortestPath> unfolded_path(
    const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
    double at_most_m = std::numeric_limits<double>::infinity());

}  // namespace palpation
