#include "results/view_data.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "results/limits.h"
#include "results/pack.h"
#include "results/parts.h"
#include "results/tour.h"

namespace palpation::results {
namespace {

using nlohmann::json;

constexpr double kMm = 1e3;
constexpr std::size_t kRoomForStates = 1'700'000;  // values, one byte each before they are text

/// Fields as a picture takes them: what the boundary is cut from, where there is a trend.
const Field& mean_of(const Tissue& tissue) {
  const Field* detrended = tissue.field("mean_detrended");
  const Field* mean = detrended != nullptr ? detrended : tissue.field("mean");
  if (mean == nullptr) throw IoError("surface.vtp: no field named mean at the points");
  return *mean;
}

std::vector<double> values_of(const Field& field) { return {field.begin(), field.end()}; }

/// Both ends of each piece of the zero line.
std::vector<Vec3> zero_line(const TriangleMesh& mesh, const Field& field) {
  std::vector<Vec3> ends;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face) {
    for (int i = 0; i < 3; ++i) {
      const int from = mesh.triangles(face, i), to = mesh.triangles(face, (i + 1) % 3);
      if ((field[from] >= 0.0) == (field[to] >= 0.0)) continue;
      const double share = field[from] / (field[from] - field[to]);
      if (!std::isfinite(share)) continue;
      ends.emplace_back((1.0 - share) * mesh.vertices.row(from) + share * mesh.vertices.row(to));
    }
    if (ends.size() % 2 != 0) ends.pop_back();
  }
  return ends;
}

std::vector<Vec3> pieces_of(const std::vector<Curve>& curves, const std::string& kind) {
  std::vector<Vec3> ends;
  for (const Curve& curve : curves) {
    if (curve.kind != kind) continue;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      ends.push_back(curve.points[i]);
      ends.push_back(curve.points[(i + 1) % curve.points.size()]);
    }
  }
  return ends;
}

/// Sides that belong to one triangle only.
std::vector<Vec3> rim_of(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> sides;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face)
    for (int i = 0; i < 3; ++i)
      sides.push_back(std::minmax({mesh.triangles(face, i), mesh.triangles(face, (i + 1) % 3)}));
  std::ranges::sort(sides);
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i + 1;
    while (next < sides.size() && sides[next] == sides[i]) ++next;
    if (next == i + 1) {
      ends.emplace_back(mesh.vertices.row(sides[i].first));
      ends.emplace_back(mesh.vertices.row(sides[i].second));
    }
    i = next;
  }
  return ends;
}

json fields_of(const Tissue& tissue, int bits) {
  json fields = {{"mean", packed(values_of(mean_of(tissue)), bits)}};
  for (const char* name : {"stddev", "probability_inside"})
    if (const Field* field = tissue.field(name)) fields[name] = packed(values_of(*field), bits);
  return fields;
}

/// How many standard deviations deep, as far as the band shows it.
json score_of(const Run& run, double band) {
  std::vector<double> score = values_of(*run.tissue.field("score"));
  for (double& value : score) value = std::clamp(value, -2.0 * band, 2.0 * band);
  return packed(score, 16);
}

int batch_of(const std::filesystem::path& step) {
  return std::atoi(step.stem().string().substr(5).c_str());  // of step_007.vtp
}

std::string name_of_batch(int batch) {
  return batch == 0 ? "After the initial touches" : "After batch " + std::to_string(batch);
}

bool is_of(const Tissue& step, const Tissue& tissue) {
  return step.mesh.vertices.rows() == tissue.mesh.vertices.rows() && step.field("mean") != nullptr;
}

/// The state after each batch but the last, which is the end unless that says otherwise.
json states_of(const Run& run, const PlaceGrid& grid) {
  json states = json::array();
  const auto bytes_each = static_cast<std::size_t>(3 * run.tissue.mesh.vertices.rows());
  const std::size_t most = std::max<std::size_t>(2, kRoomForStates / bytes_each);
  const std::size_t count = run.steps.size();
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < std::min(most, count); ++i)
    taken.insert(count <= most ? i : i * (count - 1) / (most - 1));
  int last = 0;
  for (const std::size_t i : taken) {
    const Tissue step = read_tissue(run.steps[i]);
    last = batch_of(run.steps[i]);
    if (!is_of(step, run.tissue)) continue;
    if (i + 1 == count && mean_of(step) == mean_of(run.tissue)) break;
    json state = {{"name", name_of_batch(last)}, {"batch", last}, {"fields", fields_of(step, 8)}};
    if (const Field* above = step.field("above_level"))
      state["outline"] = grid.text(zero_line(run.tissue.mesh, *above));
    states.push_back(std::move(state));
  }
  for (const Touch& touch : run.touches) last = std::max(last, touch.batch);
  states.push_back({{"name", run.summary.is_null() ? name_of_batch(last) : "In the end"},
                    {"batch", last},
                    {"isFinal", true},
                    {"isLast", true}});
  return states;
}

json lines_of(const Run& run, const PlaceGrid& grid) {
  json lines = json::object();
  for (const char* kind : {"estimate", "truth", "band_inner", "band_outer", "cut"})
    if (const std::vector<Vec3> ends = pieces_of(run.curves, kind); !ends.empty())
      lines[kind] = grid.text(ends);
  const Field* above = run.tissue.field("above_level");
  if (run.curves.empty() && above != nullptr)
    lines["estimate"] = grid.text(zero_line(run.tissue.mesh, *above));
  return lines;
}

/// [number, x, y, z, batch, kind (0 stop, 1 way, 2 missed, 3 next), whether it is set aside]
json touches_of(const Run& run) {
  json touches = json::array();
  const auto add = [&](int number, const Vec3& place, int batch, int kind, bool aside) {
    touches.push_back(
        {number, place.x() * kMm, place.y() * kMm, place.z() * kMm, batch, kind, aside ? 1 : 0});
  };
  for (const Touch& touch : run.touches)
    add(touch.number, touch.place, touch.batch,
        touch.is_missed()     ? 2
        : touch.kind == "way" ? 1
                              : 0,
        !touch.set_aside.empty());
  int number = 0;
  for (const Vec3& place : run.next_stops) add(++number, place, 0, 3, false);
  return touches;
}

json corner_mm(const Vec3& corner) {
  return {corner.x() * kMm, corner.y() * kMm, corner.z() * kMm};
}

}  // namespace

json colour_limits(const Run& run) {
  const Limits mean = limits_of_mean(values_of(mean_of(run.tissue)), run.number({"level"}),
                                     run.number({"learned", "noise_sd"}).value_or(0.0));
  const Field* stddev = run.tissue.field("stddev");
  const Limits sd =
      limits_from_zero(stddev != nullptr ? values_of(*stddev) : std::vector<double>());
  return {{"mean", {mean.lowest, mean.highest}},
          {"stddev", {sd.lowest, sd.highest}},
          {"probability_inside", {0.0, 1.0}}};
}

json view_data(const Run& run) {
  const TriangleMesh& mesh = run.tissue.mesh;
  Vec3 low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  const PlaceGrid grid(low, high);
  const std::optional<double> band = run.number({"band", "score"});
  json view = {{"vertices", mesh.vertices.rows()}, {"low", corner_mm(low)},
               {"high", corner_mm(high)},          {"unit", run.reading_unit()},
               {"level", run.told({"level"})},     {"bandScore", nullptr},
               {"limits", colour_limits(run)},     {"touches", touches_of(run)},
               {"tours", tours_of(run, grid)},     {"lines", lines_of(run, grid)},
               {"fields", json::object()},         {"states", json::array()}};
  if (mesh.vertices.rows() > kMostVertices) return view;
  const auto count = static_cast<std::size_t>(mesh.vertices.rows());
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < count; ++i)
    places.emplace_back(mesh.vertices.row(static_cast<Eigen::Index>(i)));
  std::vector<int> corners;
  for (Eigen::Index face = 0; face < mesh.triangles.rows(); ++face)
    for (int i = 0; i < 3; ++i) corners.push_back(mesh.triangles(face, i));
  view["positions"] = grid.text(places);
  view["indices"] = packed_indices(corners, count > 65535 ? 4 : 2);
  view["rim"] = grid.text(rim_of(mesh));
  view["fields"] = fields_of(run.tissue, 32);
  view["beyond"] = packed(beyond_search(run), 16);
  if (band && run.tissue.field("score") != nullptr && *band > 0.0) {
    view["bandScore"] = *band;
    view["fields"]["score"] = score_of(run, *band);
  }
  view["states"] = states_of(run, grid);
  return view;
}

}  // namespace palpation::results
