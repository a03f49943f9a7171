#include "palpation/geometry/scattered.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cross.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;  // the value
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

struct Reading {
  Vec2 place;
  double value;
};

void check(const Points2& points, const Eigen::VectorXd& values) {
  const std::string sizes =
      std::to_string(points.rows()) + " points and " + std::to_string(values.size()) + " values";
  require(points.rows() == values.size(), "ScatteredField", sizes, "must be as many");
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (points.row(i).allFinite() && std::isfinite(values[i])) continue;
    throw InvalidInput("ScatteredField: point " + std::to_string(i) + " (" + text_of(points(i, 0)) +
                       ", " + text_of(points(i, 1)) + "), value " + text_of(values[i]) +
                       " must be finite");
  }
}

/// By x, then y, so that the triangulation does not depend on the order of the readings; equal
/// places averaged.
std::vector<Reading> sorted_and_merged(const Points2& points, const Eigen::VectorXd& values) {
  std::vector<Reading> readings;
  for (Eigen::Index i = 0; i < values.size(); ++i) readings.push_back({points.row(i), values[i]});
  std::sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
    return std::tuple(a.place.x(), a.place.y(), a.value) <
           std::tuple(b.place.x(), b.place.y(), b.value);
  });
  std::vector<Reading> merged;
  for (std::size_t first = 0, last = 0; first < readings.size(); first = last) {
    double sum = 0.0;
    for (last = first; last < readings.size() && readings[last].place == readings[first].place;
         ++last)
      sum += readings[last].value;
    merged.push_back({readings[first].place, sum / static_cast<double>(last - first)});
  }
  return merged;
}

Delaunay triangulate(const std::vector<Reading>& readings) {
  std::vector<std::pair<Delaunay::Point, double>> vertices;
  for (const Reading& reading : readings)
    vertices.emplace_back(Delaunay::Point(reading.place.x(), reading.place.y()), reading.value);
  return Delaunay(vertices.begin(), vertices.end());
}

Vec2 place_of(Delaunay::Vertex_handle vertex) { return {vertex->point().x(), vertex->point().y()}; }

double interpolate(Delaunay::Face_handle face, const Vec2& place) {
  const Vec2 a = place_of(face->vertex(0)), b = place_of(face->vertex(1)),
             c = place_of(face->vertex(2));
  const double whole = cross(b - a, c - a);
  const double to_b = cross(place - a, c - a) / whole, to_c = cross(b - a, place - a) / whole;
  const double value = face->vertex(0)->info();
  return value + to_b * (face->vertex(1)->info() - value) +
         to_c * (face->vertex(2)->info() - value);
}

}  // namespace

struct ScatteredField::State {
  Delaunay triangulation;
};

ScatteredField::ScatteredField(const Points2& points, const Eigen::VectorXd& values) {
  check(points, values);
  state_ = std::make_shared<const State>(State{triangulate(sorted_and_merged(points, values))});
  require(state_->triangulation.dimension() == 2, "ScatteredField",
          std::to_string(points.rows()) + " points", "must not all be on one line");
}

std::optional<double> ScatteredField::at(const Vec2& place, double reach_m) const {
  if (!place.allFinite()) throw InvalidInput("ScatteredField::at: place must be finite");
  if (!(reach_m >= 0.0))
    throw InvalidInput("ScatteredField::at: reach_m " + text_of(reach_m) + " must not be negative");
  const Delaunay& triangulation = state_->triangulation;
  const Delaunay::Point query(place.x(), place.y());
  // The walk starts at a fixed face, and turns by a generator of its own: the same way in every
  // thread.
  Delaunay::Locate_type kind = Delaunay::OUTSIDE_AFFINE_HULL;
  int index = 0;
  Delaunay::Face_handle face =
      triangulation.locate(query, kind, index, triangulation.infinite_face());
  if (kind == Delaunay::OUTSIDE_CONVEX_HULL || kind == Delaunay::OUTSIDE_AFFINE_HULL)
    return std::nullopt;
  if (kind == Delaunay::VERTEX) return face->vertex(index)->info();
  if (triangulation.is_infinite(face))
    face = face->neighbor(index);  // on the hull: the finite side of the edge
  if ((place_of(triangulation.nearest_vertex(query, face)) - place).norm() > reach_m)
    return std::nullopt;
  return interpolate(face, place);
}

}  // namespace palpation
