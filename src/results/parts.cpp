#include "results/parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "results/clip.h"

namespace palpation::results {
namespace {

constexpr const char* kBeyond = "beyond_search";

/// Readings that count, in cubes; the nearest is exact up to the cubes' width, which it never
/// exceeds.
class Readings {
 public:
  explicit Readings(const std::vector<Vec3>& places) {
    for (const Vec3& place : places) cubes_[cube_of(place)].push_back(place);
  }

  double nearest_m(const Vec3& place) const {
    const auto [x, y, z] = cube_of(place);
    double least = kWidth_m;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto found = cubes_.find({x + i, y + j, z + k}); found != cubes_.end())
            for (const Vec3& reading : found->second)
              least = std::min(least, (reading - place).norm());
    return least;
  }

 private:
  using Cube = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  static constexpr double kWidth_m = 2.0 * kSearched_m;

  static Cube cube_of(const Vec3& place) {
    const auto step = [](double value) {
      return static_cast<std::int64_t>(std::floor(std::clamp(value, -1e6, 1e6) / kWidth_m));
    };
    return {step(place.x()), step(place.y()), step(place.z())};
  }

  std::map<Cube, std::vector<Vec3>> cubes_;
};

/// The share of a triangle where a linear field with these values at its corners is not negative.
double share_above(double a, double b, double c) {
  const int above = (a >= 0.0) + (b >= 0.0) + (c >= 0.0);
  if (above == 0 || above == 3) return above / 3;
  const bool one_is_above = above == 1;
  // The corner that is alone on its side cuts off a triangle that is similar to the whole.
  if ((b >= 0.0) == one_is_above) std::swap(a, b);
  if ((c >= 0.0) == one_is_above) std::swap(a, c);
  const double alone = a * a / ((a - b) * (a - c));
  return one_is_above ? alone : 1.0 - alone;
}

}  // namespace

std::vector<std::string> shown_fields() {
  return {"mean",           "stddev", "probability_inside",
          "mean_detrended", "score",  "above_level",
          "acquisition",    "waves",  "truth"};
}

VtpShape tumour_of(const Run& run) {
  if (run.tissue.field("above_level") != nullptr)
    return clipped(model_of(run.tissue, shown_fields()), "above_level", 0.0, Side::AtLeast);
  if (run.tissue.field("score") != nullptr)  // of runs before there was above_level
    return clipped(model_of(run.tissue, shown_fields()), "score", 0.0, Side::AtLeast);
  return {};
}

VtpShape band_of(const Run& run) {
  const std::optional<double> score = run.number({"band", "score"});
  if (!score || run.tissue.field("score") == nullptr) return {};
  const VtpShape outer =
      clipped(model_of(run.tissue, shown_fields()), "score", -*score, Side::AtLeast);
  return clipped(outer, "score", *score, Side::AtMost);
}

std::vector<double> beyond_search(const Points& places, const std::vector<Vec3>& readings) {
  const Readings near(readings);
  std::vector<double> beyond;
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    beyond.push_back(near.nearest_m(places.row(i)) - kSearched_m);
  return beyond;
}

std::vector<double> beyond_search(const Run& run) {
  std::vector<Vec3> readings;
  for (const Touch& touch : run.touches)
    if (touch.counts()) readings.push_back(touch.place);
  return beyond_search(run.tissue.mesh.vertices, readings);
}

VtpShape not_searched_of(const Run& run) {
  if (!run.knows_touches) return {};
  VtpShape whole = model_of(run.tissue, shown_fields());
  whole.point_fields.emplace_back(kBeyond, beyond_search(run));
  VtpShape part = clipped(whole, kBeyond, 0.0, Side::AtLeast);
  part.point_fields.pop_back();
  return part;
}

SearchedArea searched_area(const Run& run) {
  const TriangleMesh& mesh = run.tissue.mesh;
  const std::vector<double> beyond = beyond_search(run);
  SearchedArea area;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    const Eigen::Vector3i corners = mesh.triangles.row(face);
    const Vec3 a = mesh.vertices.row(corners[0]), b = mesh.vertices.row(corners[1]),
               c = mesh.vertices.row(corners[2]);
    const double whole = 0.5 * (b - a).cross(c - a).norm();
    area.whole_m2 += whole;
    area.not_searched_m2 +=
        whole * share_above(beyond[corners[0]], beyond[corners[1]], beyond[corners[2]]);
  }
  return area;
}

VtpShape lines_of(const std::vector<Curve>& curves, const std::vector<std::string>& kinds) {
  VtpShape model;
  std::vector<double> parts, holes;
  std::vector<std::string> names;
  for (const Curve& curve : curves) {
    if (std::ranges::find(kinds, curve.kind) == kinds.end() || curve.points.empty()) continue;
    const int first = static_cast<int>(model.points.size());
    std::vector<int>& line = model.lines.emplace_back();
    for (const Vec3& point : curve.points) {
      line.push_back(static_cast<int>(model.points.size()));
      model.points.push_back(point);
    }
    line.push_back(first);
    parts.push_back(curve.part);
    holes.push_back(curve.is_hole ? 1.0 : 0.0);
    names.push_back(curve.kind);
  }
  model.cell_fields = {{"part", parts}, {"hole", holes}};
  model.cell_texts = {{"kind_name", names}};
  return model;
}

}  // namespace palpation::results
