/// The tissue laid flat: two coordinates (u, v) in metres for every vertex, linear inside each face.
///
/// A planar surface is its own chart, without distortion. Frame: with the normal along +z, u and v are the mesh's x and y. Otherwise the
/// origin is the vertex nearest to the centroid, u follows the mesh's x axis projected to the tangent plane there (y if x is within 10
/// degrees of the normal), and the triangles run counter-clockwise as seen from outside.
#pragma once

#include <cstdint>
#include <string>

#include "palpation/base/types.h"

namespace palpation {

struct Chart {
  Points2 uv;             ///< n x 2, metres
  bool isometric = true;  ///< lengths and areas in the chart are those on the tissue

  /// 16 hexadecimal digits that name this chart: FNV-1a over the coordinates rounded to a nanometre.
  std::string hash() const;
};

}  // namespace palpation
