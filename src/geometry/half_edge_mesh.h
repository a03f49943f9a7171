/// The half-edge structure of a surface: OpenMesh in double precision.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "palpation/geometry/triangle_mesh.h"

namespace palpation {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::None);
  FaceAttributes(OpenMesh::Attributes::None);
};

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Vertices and faces keep their numbers; edges are numbered by the lowest face and corner. For
/// meshes that check_mesh has let pass, with the neighbours it found: links are set directly, since
/// OpenMesh's own add_face searches for what is known here, and repairs bad meshes silently.
HalfEdgeMesh make_half_edge_mesh(const TriangleMesh& mesh, const Triangles& neighbours);

}  // namespace palpation
