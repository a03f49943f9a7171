#include "palpation/geometry/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/careful_sum.h"
#include "geometry/flatten.h"
#include "geometry/loops_in_the_way.h"
#include "geometry/overlap.h"
#include "geometry/plane.h"
#include "geometry/surface_state.h"
#include "geometry/topology.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

Field face_areas_of(const TriangleMesh& mesh) {
  Field areas(mesh.triangles.rows());
  for (Eigen::Index f = 0; f < areas.size(); ++f) areas[f] = area_vector(mesh, f).norm();
  return areas;
}

double sum_of(const Field& terms) {
  CarefulSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

double diameter_of(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

Field thirds_of_faces(const TriangleMesh& mesh, const Field& face_areas) {
  Field areas = Field::Zero(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < face_areas.size(); ++f) {
    for (int i = 0; i < 3; ++i) areas[mesh.triangles(f, i)] += face_areas[f] / 3.0;
  }
  return areas;
}

Points angle_weighted_normals(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertices.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 normal = area_vector(mesh, f).normalized();
    for (int i = 0; i < 3; ++i) {
      const Vec3 corner = mesh.vertices.row(mesh.triangles(f, i));
      const Vec3 to_next = mesh.vertices.row(mesh.triangles(f, (i + 1) % 3)).transpose() - corner;
      const Vec3 to_last = mesh.vertices.row(mesh.triangles(f, (i + 2) % 3)).transpose() - corner;
      // The arc tangent keeps its digits in slivers, where the arc cosine loses them.
      normals.row(mesh.triangles(f, i)) +=
          std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last)) * normal.transpose();
    }
  }
  return normals;
}

/// Where the faces around a vertex cancel out (two sheets back to back), the vertex takes the
/// normal of its lowest face.
void make_unit(Points& normals, const TriangleMesh& mesh, const std::vector<int>& face_of_vertex) {
  constexpr double kCancelled =
      1e-12;  // radians of angle that are left of at least one whole angle
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > kCancelled) {
      normals.row(v) /= length;
    } else {
      normals.row(v) = area_vector(mesh, face_of_vertex[v]).normalized().transpose();
    }
  }
}

void check_index(int index, int count, const char* function, const char* what) {
  if (index >= 0 && index < count) return;
  throw InvalidInput(std::string("Surface::") + function + ": " + what + " " +
                     std::to_string(index) + " must be between 0 and " + std::to_string(count - 1));
}

void check_point(const SurfacePoint& point, int face_count, const char* function) {
  check_index(point.face, face_count, function, "face");
  const Vec3& b = point.barycentric;
  constexpr double kRounding = 1e-9;  // callers add up weights of their own
  if (b.minCoeff() >= -kRounding && std::abs(b.sum() - 1.0) <= kRounding) return;
  throw InvalidInput(std::string("Surface::") + function + ": barycentric (" + text_of(b[0]) +
                     ", " + text_of(b[1]) + ", " + text_of(b[2]) +
                     ") must be at least 0 and add up to 1");
}

}  // namespace

Surface::Surface(TriangleMesh mesh) {
  auto state = std::make_shared<State>();
  state->connectivity = check_mesh(mesh);
  state->mesh = std::move(mesh);
  state->half_edges = make_half_edge_mesh(state->mesh, state->connectivity.neighbours);
  state->border_loops = walk_borders(state->half_edges);
  state->topology = count_topology(state->half_edges, state->connectivity.neighbours,
                                   static_cast<int>(state->border_loops.size()));
  state->face_areas = face_areas_of(state->mesh);
  state->area = sum_of(state->face_areas);
  state->diameter = diameter_of(state->mesh);
  state->plane = find_plane(state->mesh, state->diameter);
  state_ = std::move(state);
}

const TriangleMesh& Surface::mesh() const { return state_->mesh; }
int Surface::vertex_count() const { return static_cast<int>(state_->mesh.vertices.rows()); }
int Surface::face_count() const { return static_cast<int>(state_->mesh.triangles.rows()); }

Vec3 Surface::vertex(int vertex) const {
  check_index(vertex, vertex_count(), "vertex", "vertex");
  return state_->mesh.vertices.row(vertex);
}

Eigen::Vector3i Surface::triangle(int face) const {
  check_index(face, face_count(), "triangle", "face");
  return state_->mesh.triangles.row(face);
}

int Surface::neighbour(int face, int corner) const {
  check_index(face, face_count(), "neighbour", "face");
  check_index(corner, 3, "neighbour", "corner");
  return state_->connectivity.neighbours(face, corner);
}

int Surface::face_of_vertex(int vertex) const {
  check_index(vertex, vertex_count(), "face_of_vertex", "vertex");
  return state_->connectivity.face_of_vertex[vertex];
}

double Surface::area() const { return state_->area; }

double Surface::face_area(int face) const {
  check_index(face, face_count(), "face_area", "face");
  return state_->face_areas[face];
}

const Field& Surface::vertex_areas() const {
  std::call_once(state_->vertex_areas_once, [this] {
    state_->vertex_areas = thirds_of_faces(state_->mesh, state_->face_areas);
  });
  return state_->vertex_areas;
}

Vec3 Surface::face_normal(int face) const {
  check_index(face, face_count(), "face_normal", "face");
  return area_vector(state_->mesh, face).normalized();
}

const Points& Surface::vertex_normals() const {
  std::call_once(state_->vertex_normals_once, [this] {
    Points normals = angle_weighted_normals(state_->mesh);
    make_unit(normals, state_->mesh, state_->connectivity.face_of_vertex);
    state_->vertex_normals = std::move(normals);
  });
  return state_->vertex_normals;
}

double Surface::diameter() const { return state_->diameter; }
const std::vector<std::vector<int>>& Surface::border_loops() const { return state_->border_loops; }
Topology Surface::topology() const { return state_->topology; }
bool Surface::is_planar() const { return state_->plane.is_plane && !state_->laid_flat().overlap; }

SurfacePoint Surface::at_vertex(int vertex) const {
  const int face = face_of_vertex(vertex);
  SurfacePoint point{face, Vec3::Zero()};
  for (int i = 0; i < 3; ++i)
    point.barycentric[i] = state_->mesh.triangles(face, i) == vertex ? 1.0 : 0.0;
  return point;
}

int Surface::vertex_at(const SurfacePoint& point) const {
  for (int corner = 0; corner < 3; ++corner) {
    if (point.barycentric[corner] == 1.0) return triangle(point.face)[corner];
  }
  return -1;
}

Vec3 Surface::position(const SurfacePoint& point) const {
  check_point(point, face_count(), "position");
  Vec3 position = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    position += point.barycentric[i] *
                state_->mesh.vertices.row(state_->mesh.triangles(point.face, i)).transpose();
  return position;
}

Vec3 Surface::normal(const SurfacePoint& point) const {
  check_point(point, face_count(), "normal");
  const Points& normals = vertex_normals();
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    normal += point.barycentric[i] * normals.row(state_->mesh.triangles(point.face, i)).transpose();
  constexpr double kCancelled = 1e-12;  // of unit vectors' mean: opposite normals at a fold
  return normal.norm() > kCancelled ? normal.normalized() : face_normal(point.face);
}

double Surface::interpolate(const Field& field, const SurfacePoint& point) const {
  check_point(point, face_count(), "interpolate");
  if (field.size() != vertex_count()) {
    throw InvalidInput("Surface::interpolate: field of " + std::to_string(field.size()) +
                       " values must have one for each of the " + std::to_string(vertex_count()) +
                       " vertices");
  }
  double value = 0.0;
  for (int i = 0; i < 3; ++i) {
    // A weight of zero leaves a value out even where that is infinite.
    if (point.barycentric[i] != 0.0)
      value += point.barycentric[i] * field[state_->mesh.triangles(point.face, i)];
  }
  return value;
}

int Surface::nearest_vertex(const Vec3& position) const {
  require(position.allFinite(), "Surface::nearest_vertex", "position", "must be finite");
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < vertex_count(); ++v) {
    const double distance_squared =
        (state_->mesh.vertices.row(v).transpose() - position).squaredNorm();
    if (distance_squared < least) {
      least = distance_squared;
      nearest = v;
    }
  }
  return nearest;
}

const Surface::State& Surface::State::laid_flat() const {
  std::call_once(chart_once, [this] {
    chart = lay_flat(mesh, plane, diameter);
    overlap = place_of_overlap(mesh.triangles, connectivity.neighbours, border_loops, chart.uv);
  });
  return *this;
}

const Surface::State& Surface::State::flattened() const {
  std::call_once(chart_once, [this] {
    Flattened made = flatten(mesh, connectivity, border_loops, area, diameter);
    chart = std::move(made.chart);
    chart_fault = std::move(made.fault);
    const std::lock_guard lock(computed_guard);
    computed.insert("chart");
  });
  return *this;
}

void Surface::State::refuse_chart() const {
  const auto refuse = [](const std::string& what, const std::string& rule) {
    require(false, "Surface::chart", what, "has no chart: " + rule);
  };
  if (plane.folded_face)
    refuse("a flat surface that is folded",
           "triangle " + std::to_string(*plane.folded_face) + " looks the other way");
  if (plane.is_plane) {
    const Vec2 place = laid_flat().overlap.value_or(Vec2::Zero());
    refuse("a flat surface that lies over itself",
           "two of its sheets cover u = " + text_of(place.x()) + " m, v = " + text_of(place.y()) +
               " m of its plane");
  }
  const std::string reason = topology.is_disk()
                                 ? flattened().chart_fault
                                 : loops_in_the_way(topology, border_loops, mesh.vertices);
  refuse("a curved surface", reason + "; work on a patch of it");
}

const Chart& Surface::chart() const {
  if (!has_chart() || (!state_->is_flat() && !state_->flattened().chart_fault.empty()))
    state_->refuse_chart();
  return state_->chart;
}

bool Surface::has_chart() const {
  return state_->is_flat() ? is_planar() : state_->topology.is_disk();
}

std::vector<std::string> Surface::computed() const {
  const std::lock_guard lock(state_->computed_guard);
  return {state_->computed.begin(), state_->computed.end()};
}

void Surface::note_computed(const std::string& what) const {
  const std::lock_guard lock(state_->computed_guard);
  state_->computed.insert(what);
}

}  // namespace palpation
