/// A tissue surface: an oriented, edge-manifold triangle mesh that has been checked, and all that
/// can be asked of it.
///
/// Immutable; if you hold one, it is valid; copies share. What a scene may not need (chart, search
/// tree, geodesics) is computed when it is first asked for, once, under a lock, and `computed()`
/// tells.
///
/// Contract of a valid surface: at least one triangle; finite coordinates; every index in range; no
/// triangle with a repeated vertex, zero area or an edge of zero length; every vertex used; every
/// edge in one or two triangles, which run through it in opposite directions; the triangles around
/// a vertex form one fan; between 1e-60 and 1e60 m across, so that areas are numbers. An area is
/// zero when it is no more than rounding: 4.5e-16 of the longest edge's square. It may be closed or
/// have borders, handles and several components.
///
/// Indices out of range, points that are none (weights off by more than 1e-9) and positions that
/// are not finite throw InvalidInput. References that are handed out live as long as any copy of
/// the surface.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "palpation/geometry/chart.h"
#include "palpation/geometry/surface_point.h"
#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

class Spectrum;
struct SpectrumRange;

/// What kind of surface it is.
struct Topology {
  int components = 0;
  int borders = 0;  ///< border loops
  int euler = 0;    ///< vertices - edges + faces
  int handles = 0;  ///< genus, added up over the components
  bool is_disk() const { return components == 1 && borders == 1 && handles == 0; }
  bool is_closed() const { return borders == 0; }
};

class Surface {
 public:
  /// Checks the mesh (see the contract above). Throws InvalidMesh, naming the first element at
  /// fault, its position and the rule.
  explicit Surface(TriangleMesh mesh);

  const TriangleMesh& mesh() const;
  int vertex_count() const;
  int face_count() const;
  Vec3 vertex(int vertex) const;             ///< position, metres
  Eigen::Vector3i triangle(int face) const;  ///< its three vertices
  /// The face across the edge from corner i to corner i+1 (mod 3) of a face, or -1 at the border.
  int neighbour(int face, int corner) const;
  /// Any face of a vertex, the lowest index.
  int face_of_vertex(int vertex) const;

  double area() const;                   ///< m2, summed in face order without loss (Neumaier)
  double face_area(int face) const;      ///< m2
  const Field& vertex_areas() const;     ///< a third of the faces around each vertex, m2
  Vec3 face_normal(int face) const;      ///< outward, unit
  const Points& vertex_normals() const;  ///< outward, unit, weighted by the angle at the vertex
  double diameter() const;               ///< length of the bounding box' diagonal, metres

  /// Loops of border vertices, each with the tissue on its left seen from outside; the loop with
  /// the lowest vertex first, from that vertex.
  const std::vector<std::vector<int>>& border_loops() const;
  Topology topology() const;
  bool is_planar() const;  ///< all vertices in one plane to 1e-6 of the diameter, all normals
                           ///< alike, nowhere two sheets

  SurfacePoint at_vertex(int vertex) const;
  /// The vertex where a point lies, or -1: the corner that has all its weight.
  int vertex_at(const SurfacePoint& point) const;
  Vec3 position(const SurfacePoint& point) const;
  Vec3 normal(const SurfacePoint& point) const;  ///< vertex normals interpolated, unit
  /// Linear interpolation of a field at the vertices.
  double interpolate(const Field& field, const SurfacePoint& point) const;
  /// The vertex nearest to a point of space in a straight line, the lowest index of equals. Linear
  /// search: needs no tree.
  int nearest_vertex(const Vec3& position) const;
  /// The closest point of the surface to a point of space; ties (to 1e-12 of the diameter) go to
  /// the lowest face. Builds a search tree at first use.
  SurfacePoint project(const Vec3& position) const;

  /// The chart: for a planar surface its own plane, at no cost; for another disk computed at first
  /// use. Throws InvalidInput where there is none, and says what is in the way: see chart.h.
  const Chart& chart() const;
  /// Whether it is planar, or a disk that does not lie flat upon itself. Costs nothing; chart()
  /// still refuses the few disks whose flattening would lie over itself.
  bool has_chart() const;
  /// The slow waves of the surface's Laplacian (spectrum.h), made once for each range that is asked
  /// for. Throws as spectrum_of.
  std::shared_ptr<const Spectrum> spectrum(const SpectrumRange& range) const;

  /// All vertices in an order in which most neighbours in space are near each other in the list, so
  /// that what is stored in it is read together: Morton's curve through the bounding box, equals by
  /// their index.
  const std::vector<int>& locality_order() const;

  /// What has been computed so far beyond the mesh itself, in alphabetical order: of "chart",
  /// "features", "geodesics", "search tree", "spectrum".
  std::vector<std::string> computed() const;
  /// Says that something costly was computed for this surface (used by the functions of this
  /// folder).
  void note_computed(const std::string& what) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace palpation
