#include "palpation/geometry/reconstruct.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "geometry/neighbours.h"
#include "geometry/triangulate.h"
#include "geometry/trim.h"
#include "palpation/base/error.h"
#include "palpation/geometry/surface.h"
#include "palpation/geometry/thin.h"

namespace palpation {
namespace {

constexpr int kLeastPoints = 12;
constexpr int kNeighbours = 12;
constexpr int kJetNeighbours = 18;
constexpr double kFarSpacings = 2.0;  // off the neighbours' plane ...
constexpr double kFarUsual = 10.0;    // and so many times the median
constexpr double kSteep = 0.3;        // cosine of 72 degrees
constexpr double kMostSteep = 0.03;   // of the points, where a projection is taken
constexpr double kMostVertices = 20e3, kMostVerticesAsked = 1e6;
constexpr double kClearTilt = 0.5;  // cosine between the plane's normal and the probe's side

void check(const Points& points, const Points& outward, const ReconstructOptions& options) {
  const auto must = [](bool holds, const std::string& value, const std::string& rule) {
    require(holds, "reconstruct", value, rule);
  };
  must(points.rows() == outward.rows(),
       std::to_string(points.rows()) + " points and " + std::to_string(outward.rows()) +
           " directions",
       "must be as many");
  must(points.allFinite() && outward.allFinite(), "points and directions", "must be finite");
  must(points.rows() == 0 || outward.rowwise().squaredNorm().minCoeff() > 0.0, "directions",
       "must not be zero");
  must(std::isfinite(options.gap) && options.gap >= 1.5, "gap = " + text_of(options.gap),
       "must be at least 1.5");
  must(std::isfinite(options.fairing) && options.fairing >= 0.5,
       "fairing = " + text_of(options.fairing), "must be at least .5");
  must(std::isfinite(options.edge_m) && options.edge_m >= 0.0,
       "edge_m = " + text_of(options.edge_m), "must not be negative");
  must(options.most_points >= 100, "most_points = " + std::to_string(options.most_points),
       "must be at least 100");
}

Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes_of(const Points& points) {
  const Points centred = points.rowwise() - points.colwise().mean();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred);
}

/// Points with a direction each.
struct Contacts {
  Points points, outward;
};

Contacts thinned_contacts(const Thinned& thinned, const Points& outward) {
  Contacts result{thinned.points, Points::Zero(thinned.points.rows(), 3)};
  for (std::size_t i = 0; i < thinned.group.size(); ++i)
    result.outward.row(thinned.group[i]) += outward.row(static_cast<Eigen::Index>(i)).normalized();
  // Of opposite ones nothing is left: then any is as good, and the neighbours tell.
  for (Eigen::Index i = 0; i < result.outward.rows(); ++i) {
    if (result.outward.row(i).squaredNorm() == 0.0) result.outward.row(i) << 0.0, 0.0, 1e-300;
  }
  return result;
}

/// How far each point is off the plane of its neighbours, and how far they are.
struct Loneliness {
  Field off, spacing;
};

Loneliness loneliness(const Points& points) {
  const std::vector<std::vector<int>> nearest = nearest_others(points, kNeighbours);
  Loneliness result{Field(points.rows()), Field(points.rows())};
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const std::vector<int>& others = nearest[static_cast<std::size_t>(i)];
    const Points around = points(others, Eigen::all);
    const Vec3 normal = axes_of(around).eigenvectors().col(0);
    result.off[i] = std::abs(normal.dot(points.row(i) - around.colwise().mean()));
    // Twelve points of a lattice lie within 1.95 of its steps.
    result.spacing[i] = (points.row(others.back()) - points.row(i)).norm() / 1.95;
  }
  return result;
}

double median(Field values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<bool> far_points(const Points& points) {
  const Loneliness of = loneliness(points);
  const double least = std::max(kFarSpacings * median(of.spacing), kFarUsual * median(of.off));
  std::vector<bool> far(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < far.size(); ++i)
    far[i] = of.off[static_cast<Eigen::Index>(i)] > least;
  return far;
}

Contacts without(const Contacts& contacts, const std::vector<bool>& left_out) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (!left_out[i]) kept.push_back(static_cast<int>(i));
  }
  return {contacts.points(kept, Eigen::all), contacts.outward(kept, Eigen::all)};
}

/// Along what a projection would be: the plane's normal on the probe's side, or that side itself
/// where the points lie far from any plane that it sees.
Vec3 view_of(const Contacts& contacts) {
  const Vec3 plane = axes_of(contacts.points).eigenvectors().col(0);
  const Vec3 side = contacts.outward.rowwise().normalized().colwise().sum().transpose();
  if (side.norm() < 1e-9 * static_cast<double>(contacts.points.rows())) return plane;
  const double cosine = plane.dot(side.normalized());
  if (std::abs(cosine) < kClearTilt) return side.normalized();
  return cosine > 0.0 ? plane : Vec3(-plane);
}

/// Each vertex' height over a plane as the median of those around and its own: without noise that
/// is less than the waves.
Field median_heights(const TriangleMesh& mesh, const Vec3& view) {
  const Field heights = mesh.vertices * view;
  std::vector<std::vector<double>> around(static_cast<std::size_t>(heights.size()));
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int i = 0; i < 3; ++i)
      around[static_cast<std::size_t>(t[i])].push_back(heights[t[(i + 1) % 3]]);
  }
  Field result = heights;
  for (Eigen::Index i = 0; i < heights.size(); ++i) {
    std::vector<double>& others = around[static_cast<std::size_t>(i)];
    others.push_back(heights[i]);
    result[i] = median(Eigen::Map<Field>(others.data(), static_cast<Eigen::Index>(others.size())));
  }
  return result;
}

/// The part of the points around which most triangles are steep.
double steep_part(TriangleMesh mesh, const Vec3& view) {
  mesh.vertices += (median_heights(mesh, view) - mesh.vertices * view) * view.transpose();
  Field steep = Field::Zero(mesh.vertices.rows()), all = steep;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
               c = mesh.vertices.row(t[2]);
    const Vec3 normal = (b - a).cross(c - a);
    for (int i = 0; i < 3; ++i) {
      all[t[i]] += 1.0;
      if (normal.dot(view) < kSteep * normal.norm()) steep[t[i]] += 1.0;
    }
  }
  return (steep.array() > 0.5 * all.array()).cast<double>().mean();
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
               c = mesh.vertices.row(t[2]);
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

/// Triangles of about equal sides and so many vertices have this edge.
double edge_for(double area, double vertices) {
  return std::sqrt(2.0 * area / (std::sqrt(3.0) * vertices));
}

double edge_of(const TriangleMesh& mesh, double spacing_m, double asked_m) {
  const double area = area_of(mesh);
  if (asked_m == 0.0) return std::max(0.5 * spacing_m, edge_for(area, kMostVertices));
  const double least_m = edge_for(area, kMostVerticesAsked);
  require(asked_m >= least_m, "reconstruct", "edge_m = " + text_of(asked_m),
          "would take more than a million vertices: take at least " + text_of(least_m));
  return asked_m;
}

/// Triangles over the points, and what they were seen along: zero for none.
struct Rough {
  TriangleMesh mesh;
  Vec3 view = Vec3::Zero();
};

Rough triangulate(const Contacts& contacts, Triangulation by) {
  if (by != Triangulation::AdvancingFront) {
    const Vec3 view = view_of(contacts);
    Rough rough{{contacts.points, triangulate_along(contacts.points, view)}, view};
    if (by == Triangulation::Projection || steep_part(rough.mesh, view) <= kMostSteep) return rough;
  }
  const Points smooth = smooth_by_jets(contacts.points, kJetNeighbours);
  return {{smooth, advance_front(smooth)}, Vec3::Zero()};
}

void mesh_evenly(const Contacts& contacts, const ReconstructOptions& options,
                 Reconstruction& result) {
  Rough rough = triangulate(contacts, options.by);
  result.by = rough.view.isZero(0.0) ? Triangulation::AdvancingFront : Triangulation::Projection;
  result.spacing_m = sample_spacing(rough.mesh);
  Trimmed trimmed = trim(rough.mesh, options.gap * result.spacing_m,
                         rough.view.isZero(0.0) ? Folds::Part : Folds::Keep);
  if (trimmed.mesh.triangles.rows() == 0)
    throw NumericalError(
        "reconstruct: the points lie too unevenly for a surface between them: no triangle has a "
        "circle of at most " +
        text_of(options.gap) + " sample spacings of " + text_of(result.spacing_m) + " m");
  face_outward(trimmed.mesh, contacts.outward(trimmed.kept, Eigen::all));
  if (!rough.view.isZero(0.0)) trimmed.mesh = fair(std::move(trimmed.mesh), 1.0, rough.view);
  result.edge_m = edge_of(trimmed.mesh, result.spacing_m, options.edge_m);
  result.mesh = remesh(trimmed.mesh, result.edge_m);
  result.mesh = fair(std::move(result.mesh), options.fairing * result.spacing_m / result.edge_m,
                     Vec3::Zero());
}

}  // namespace

Reconstruction reconstruct(const Points& points, const Points& outward,
                           const ReconstructOptions& options) {
  check(points, outward, options);
  const Thinned thinned = thin(points, options.most_points);
  require(thinned.points.rows() >= kLeastPoints, "reconstruct",
          std::to_string(thinned.points.rows()) + " different points",
          "are too few: a surface takes at least " + std::to_string(kLeastPoints));
  const Vec3 spread = axes_of(thinned.points).eigenvalues();
  require(spread[1] > 1e-12 * spread[2], "reconstruct", "points", "must not all lie on a line");

  Reconstruction result;
  result.thinned_m = thinned.radius_m;
  const std::vector<bool> far = far_points(thinned.points);
  for (std::size_t i = 0; i < thinned.group.size(); ++i) {
    if (far[static_cast<std::size_t>(thinned.group[i])])
      result.outliers.push_back(static_cast<int>(i));
  }
  const Contacts contacts = without(thinned_contacts(thinned, outward), far);
  try {
    mesh_evenly(contacts, options, result);
    Surface checked(result.mesh);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw NumericalError(std::string("reconstruct: CGAL failed on these points: ") + error.what());
  }
  return result;
}

}  // namespace palpation
