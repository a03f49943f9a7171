#include "geometry/metric_builder.h"

#include <algorithm>
#include <cmath>

namespace palpation {
namespace {

constexpr double kMuchLonger = 1.8;

}  // namespace

MetricBuilder::MetricBuilder(const MetricMesh& mesh)
    : vertex_count_(mesh.vertex_count), fixed_(static_cast<int>(mesh.triangles.rows())) {
  faces_.reserve(static_cast<std::size_t>(fixed_) * 5 / 4);
  for (int face = 0; face < fixed_; ++face) {
    faces_.push_back(
        {mesh.triangles.row(face), mesh.lengths.row(face), mesh.across.row(face), 0.0});
  }
}

int MetricBuilder::add_face(const Eigen::Vector3i& vertices, const Vec3& lengths, double target) {
  faces_.push_back({vertices, lengths, Eigen::Vector3i::Constant(-1), target});
  return static_cast<int>(faces_.size()) - 1;
}

void MetricBuilder::glue(int half_edge, int other) {
  faces_[half_edge / 3].across[half_edge % 3] = other;
  faces_[other / 3].across[other % 3] = half_edge;
}

double MetricBuilder::angle(int face, int corner) const {
  MetricMesh one{3, Triangles(1, 3), MetricMesh::Lengths(1, 3), Triangles(1, 3)};
  one.lengths.row(0) = faces_[face].lengths;
  return angle_of(one, 0, corner);
}

/// The part of a half-edge's face beyond the middle of the edge becomes a face of its own; returns
/// it. Its edge 0 is the second half.
int MetricBuilder::halve(int half_edge, int middle) {
  const int f = half_edge / 3, i = half_edge % 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  const Face whole = faces_[f];
  const double a = whole.lengths[i1], b = whole.lengths[i2], c = whole.lengths[i];
  const double median = 0.5 * std::sqrt(std::max(2.0 * (a * a + b * b) - c * c, 1e-12 * c * c));
  const int fresh = add_face({middle, whole.vertices[i1], whole.vertices[i2]}, {0.5 * c, a, median},
                             whole.target);
  const int beyond = whole.across[i1];
  if (beyond >= 0) glue(3 * fresh + 1, beyond);
  Face& kept = faces_[f];
  kept.vertices[i1] = middle;
  kept.lengths[i] = 0.5 * c;
  kept.lengths[i1] = median;
  glue(3 * f + i1, 3 * fresh + 2);
  return fresh;
}

void MetricBuilder::split(int half_edge) {
  const int other = faces_[half_edge / 3].across[half_edge % 3];
  const int middle = add_vertex();
  const int fresh = halve(half_edge, middle);
  faces_[fresh].across[0] = -1;
  if (other < 0) return;
  const int fresh_other = halve(other, middle);
  glue(half_edge, 3 * fresh_other);
  glue(other, 3 * fresh);
}

void MetricBuilder::flip_to_delaunay() {
  MetricMesh mesh = done();
  palpation::flip_to_delaunay(mesh, [&](int face, int beyond) {
    return face >= fixed_ && beyond >= fixed_ && faces_[face].target == faces_[beyond].target;
  });
  for (int face = 0; face < static_cast<int>(faces_.size()); ++face) {
    faces_[face] = {mesh.triangles.row(face), mesh.lengths.row(face), mesh.across.row(face),
                    faces_[face].target};
  }
}

void MetricBuilder::split_long_edges() {
  // Beside an edge that stays whole no triangle can have much shorter ones.
  for (std::size_t face = static_cast<std::size_t>(fixed_); face < faces_.size(); ++face) {
    Face& here = faces_[face];
    for (int corner = 0; corner < 3; ++corner) {
      const int beyond = here.across[corner];
      if (beyond >= 0 && beyond / 3 < fixed_)
        here.target = std::max(here.target, here.lengths[corner]);
    }
  }
  for (int face = fixed_; face < static_cast<int>(faces_.size()); ++face) {
    for (bool again = true; again;) {
      again = false;
      int longest = -1;
      for (int corner = 0; corner < 3; ++corner) {
        const Face& here = faces_[face];
        const int beyond = here.across[corner];
        if (beyond >= 0 && (beyond / 3 < fixed_ || beyond / 3 == face)) continue;
        if (here.lengths[corner] > kMuchLonger * here.target &&
            (longest < 0 || here.lengths[corner] > here.lengths[longest]))
          longest = corner;
      }
      if (longest >= 0) {
        split(3 * face + longest);
        again = true;
      }
    }
  }
}

MetricMesh MetricBuilder::done() const {
  const auto count = static_cast<Eigen::Index>(faces_.size());
  MetricMesh mesh{vertex_count_, Triangles(count, 3), MetricMesh::Lengths(count, 3),
                  Triangles(count, 3)};
  for (Eigen::Index face = 0; face < count; ++face) {
    mesh.triangles.row(face) = faces_[face].vertices;
    mesh.lengths.row(face) = faces_[face].lengths;
    mesh.across.row(face) = faces_[face].across;
  }
  return mesh;
}

}  // namespace palpation
