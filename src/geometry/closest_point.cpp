#include "geometry/closest_point.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

namespace palpation {
namespace {

// CGAL divides space; all distances are computed below, so that ties are seen alike in every face.
using Kernel = CGAL::Simple_cartesian<double>;

constexpr double kTie = 1e-12;  // of the diameter: well above the rounding of a distance, well
                                // below anything that is measured

Kernel::Point_3 cgal_vertex(const TriangleMesh& mesh, int vertex) {
  return {mesh.vertices(vertex, 0), mesh.vertices(vertex, 1), mesh.vertices(vertex, 2)};
}

/// A face, as CGAL's tree wants to see it.
class FacePrimitive {
 public:
  using Id = int;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Triangle_3;

  FacePrimitive() = default;
  FacePrimitive(const TriangleMesh* mesh, int face) : mesh_(mesh), face_(face) {}
  Id id() const { return face_; }
  Point reference_point() const { return cgal_vertex(*mesh_, mesh_->triangles(face_, 0)); }
  Datum datum() const {
    const auto corner = mesh_->triangles.row(face_);
    return {cgal_vertex(*mesh_, corner[0]), cgal_vertex(*mesh_, corner[1]),
            cgal_vertex(*mesh_, corner[2])};
  }

 private:
  const TriangleMesh* mesh_ = nullptr;
  int face_ = -1;
};

using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, FacePrimitive>>;

/// A point of a face and how far away it is.
struct Candidate {
  double distance = std::numeric_limits<double>::infinity();
  SurfacePoint point;
};

using Corners = Eigen::Matrix3d;  // one column a corner

Corners corners_of(const TriangleMesh& mesh, int face) {
  Corners corners;
  for (int i = 0; i < 3; ++i) corners.col(i) = mesh.vertices.row(mesh.triangles(face, i));
  return corners;
}

/// Weights of the foot of the perpendicular on the triangle's plane: areas of the three parts over
/// the whole.
Vec3 weights_of_foot(const Corners& x, const Vec3& place) {
  const Vec3 normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0));
  Vec3 weights;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    weights[i] = (x.col(k) - x.col(j)).cross(place - x.col(j)).dot(normal);
  }
  return weights / normal.squaredNorm();
}

Vec3 weights_on_edge(const Corners& x, int from, const Vec3& place) {
  const int to = (from + 1) % 3;
  const Vec3 edge = x.col(to) - x.col(from);
  const double share = std::clamp(edge.dot(place - x.col(from)) / edge.squaredNorm(), 0.0, 1.0);
  Vec3 weights = Vec3::Zero();
  weights[from] = 1.0 - share;
  weights[to] = share;
  return weights;
}

Candidate closest_in_face(const TriangleMesh& mesh, int face, const Vec3& place) {
  const Corners x = corners_of(mesh, face);
  Candidate best;
  const auto consider = [&](const Vec3& weights) {
    const double distance = (x * weights - place).norm();
    if (distance < best.distance) best = {distance, {face, weights}};
  };
  for (int i = 0; i < 3; ++i) consider(weights_on_edge(x, i, place));
  const Vec3 foot = weights_of_foot(x, place);
  if (foot.minCoeff() > 0.0) consider(foot / foot.sum());
  return best;
}

double distance_to_box(const CGAL::Bbox_3& box, const Vec3& place) {
  Vec3 outside;
  for (int i = 0; i < 3; ++i)
    outside[i] = std::max({box.min(i) - place[i], place[i] - box.max(i), 0.0});
  return outside.norm();
}

/// Collects every face that is about as close as the closest so far.
class Search {
 public:
  using Node = CGAL::AABB_node<CGAL::AABB_traits<Kernel, FacePrimitive>>;

  Search(const TriangleMesh& mesh, double tie, double known_distance)
      : mesh_(mesh), tie_(tie), least_(known_distance) {}

  bool go_further() const { return true; }
  bool do_intersect(const Vec3& place, const Node& node) const {
    return distance_to_box(node.bbox(), place) <= least_ + tie_;
  }
  void intersection(const Vec3& place, const FacePrimitive& primitive) {
    const Candidate candidate = closest_in_face(mesh_, primitive.id(), place);
    if (candidate.distance > least_ + tie_) return;
    least_ = std::min(least_, candidate.distance);
    candidates_.push_back(candidate);
  }

  SurfacePoint lowest_of_closest() const {
    const Candidate* lowest = nullptr;
    for (const Candidate& candidate : candidates_) {
      if (candidate.distance > least_ + tie_) continue;
      if (lowest == nullptr || candidate.point.face < lowest->point.face) lowest = &candidate;
    }
    return lowest->point;
  }

 private:
  const TriangleMesh& mesh_;
  double tie_, least_;
  std::vector<Candidate> candidates_;
};

}  // namespace

struct ClosestPoint::Tree {
  const TriangleMesh& mesh;
  double diameter;
  AabbTree boxes;
};

ClosestPoint::ClosestPoint(const TriangleMesh& mesh, const std::vector<int>& face_of_vertex,
                           double diameter) {
  std::unique_ptr<Tree> tree(new Tree{mesh, diameter, {}});
  for (int face = 0; face < mesh.triangles.rows(); ++face)
    tree->boxes.insert(FacePrimitive(&mesh, face));
  tree->boxes.build();
  std::vector<std::pair<Kernel::Point_3, int>> hints;
  for (int v = 0; v < mesh.vertices.rows(); ++v)
    hints.emplace_back(cgal_vertex(mesh, v), face_of_vertex[v]);
  tree->boxes.accelerate_distance_queries(hints.begin(), hints.end());
  tree_ = std::move(tree);
}

ClosestPoint::~ClosestPoint() = default;

SurfacePoint ClosestPoint::to(const Vec3& place) const {
  const auto hint = tree_->boxes.best_hint({place.x(), place.y(), place.z()});
  const double far_enough = closest_in_face(tree_->mesh, hint.second, place).distance;
  // Far away, a distance is rounded by more than a share of the diameter.
  const double tie = kTie * std::max(tree_->diameter, far_enough);
  Search search(tree_->mesh, tie, far_enough);
  tree_->boxes.traversal(place, search);
  return search.lowest_of_closest();
}

}  // namespace palpation
