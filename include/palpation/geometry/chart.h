/// The tissue laid flat: two coordinates (u, v) in metres for every vertex, linear inside each
/// face.
///
/// A planar surface is its own chart, without distortion. Any other topological disk is flattened
/// with as little stretch as can be: exactly, triangle by triangle, where it is developable (a
/// faceted cylinder); else as rigid as possible (Liu et al. 2008), or, where that would turn
/// triangles over, by least symmetric stretch (Smith and Schaefer 2015). The chart's area is the
/// tissue's.
///
/// Frame: with the normal of a plane along +z, u and v are the mesh's x and y. Otherwise the origin
/// is the vertex nearest to the centroid (of equals the one with the lowest x, then y, then z), u
/// follows the mesh's x axis projected to the tangent plane there (y if x is within 10 degrees of
/// the normal), and the triangles run counter-clockwise as seen from outside.
#pragma once

#include <cstdint>
#include <string>

#include "palpation/base/types.h"

namespace palpation {

/// How far a chart is from the tissue, over all faces: stretch is length in the chart over length
/// on the tissue, by direction.
struct Distortion {
  double least_stretch = 1.0;
  double greatest_stretch = 1.0;
  double least_area_ratio = 1.0;  ///< area in the chart over area on the tissue
  double greatest_area_ratio = 1.0;
  double rms_stretch_error =
      0.0;  ///< of stretch - 1 over the two principal directions, weighted by area
};

struct Chart {
  Points2 uv;             ///< n x 2, metres
  bool isometric = true;  ///< lengths and areas in the chart are those on the tissue: no stretch is
                          ///< off 1 by more than 1e-6
  Distortion distortion{};

  /// 16 hexadecimal digits that name this chart: FNV-1a over the coordinates rounded to a
  /// nanometre.
  std::string hash() const;
};

}  // namespace palpation
