/// What the copies of a Surface share.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/check_mesh.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/spectrum.h"

namespace palpation {

class ClosestPoint;

/// The plane of a flat surface.
struct Plane {
  bool is_plane = false;
  Vec3 normal = Vec3::UnitZ();
  std::optional<Eigen::Index> folded_face =
      std::nullopt;  ///< a face that looks the other way, where all else is flat
};

/// All but the last group is fixed when the constructor is done. What is mutable is made at first
/// use, each under its own flag.
struct Surface::State {
  /// Whether it lies in a plane, folded or not.
  bool is_flat() const { return plane.is_plane || plane.folded_face; }
  /// With the chart, and the overlap if there is one. Only for what is in a plane.
  const State& laid_flat() const;
  /// With the chart, or its fault. Only for disks that are not flat.
  const State& flattened() const;
  /// Throws InvalidInput that says why there is none.
  void refuse_chart() const;

  TriangleMesh mesh;
  Connectivity connectivity;
  HalfEdgeMesh half_edges;
  std::vector<std::vector<int>> border_loops;
  Topology topology;
  Field face_areas;
  double area = 0.0;
  double diameter = 0.0;
  Plane plane;

  mutable std::once_flag vertex_areas_once, vertex_normals_once, chart_once, closest_point_once,
      order_once;
  mutable Field vertex_areas;
  mutable Points vertex_normals;
  mutable Chart chart;
  mutable std::optional<Vec2> overlap;  ///< where a flat surface lies over itself, in its plane
  mutable std::string chart_fault;      ///< why a curved disk has no chart after all
  mutable std::shared_ptr<const ClosestPoint> closest_point;
  mutable std::vector<int> locality_order;

  mutable std::mutex spectra_guard;
  mutable std::map<SpectrumRange, std::shared_ptr<const Spectrum>> spectra;

  mutable std::mutex computed_guard;
  mutable std::set<std::string> computed;
};

}  // namespace palpation
