#include "palpation/world/recording.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "palpation/base/error.h"
#include "world/plane_map.h"

namespace palpation {
namespace {

constexpr double kStandstill_m = 1e-6;
constexpr double kOneWay =
    0.8;  // length of the mean direction of rows that run one way, poses trembling a little
constexpr double kJump_m = 0.005;  // from the end of one row to the start of the next

void check(const RecordedReadings& recording, const std::string& name) {
  const Eigen::Index count = recording.positions.rows();
  require(recording.readings.size() == count, "RecordedWorld",
          name + ": " + std::to_string(count) + " positions and " +
              std::to_string(recording.readings.size()) + " readings",
          "must be equally many");
  require(count >= 3, "RecordedWorld", name + ": " + std::to_string(count) + " readings",
          "must be at least three");
  require(recording.positions.allFinite() && recording.readings.allFinite(), "RecordedWorld", name,
          "must be finite");
}

/// The mean of the unit steps: close to a unit vector for rows that run one way, close to zero for
/// rows that run to and fro.
Vec3 mean_direction(const Points& positions) {
  Vec3 sum = Vec3::Zero();
  int steps = 0;
  for (Eigen::Index i = 1; i < positions.rows(); ++i) {
    const Vec3 step = positions.row(i) - positions.row(i - 1);
    const double length = step.norm();
    if (length <= kStandstill_m || length > kJump_m) continue;
    sum += step / length;
    ++steps;
  }
  return steps == 0 ? sum : Vec3(sum / steps);
}

std::vector<bool> border_vertices(const Surface& surface) {
  std::vector<bool> on_border(static_cast<std::size_t>(surface.vertex_count()), false);
  for (const std::vector<int>& loop : surface.border_loops()) {
    for (const int vertex : loop) on_border[vertex] = true;
  }
  return on_border;
}

/// A border vertex may be told by a face that has no border edge.
bool is_on_border(const Surface& surface, const std::vector<bool>& border,
                  const SurfacePoint& point) {
  const Eigen::Vector3i corners = surface.triangle(point.face);
  for (int i = 0; i < 3; ++i) {
    if (point.barycentric[i] > 1.0 - 1e-9 && border[corners[i]]) return true;
    if (point.barycentric[(i + 2) % 3] < 1e-9 && surface.neighbour(point.face, i) < 0) return true;
  }
  return false;
}

/// How far beside the tissue a point of space lies, apart from its height over the surface.
double beyond_border_m(const Surface& surface, const std::vector<bool>& border,
                       const Vec3& position, const SurfacePoint& closest) {
  if (!is_on_border(surface, border, closest)) return 0.0;
  const Vec3 normal = surface.face_normal(closest.face);
  const Vec3 offset = position - surface.position(closest);
  return (offset - normal.dot(offset) * normal).norm();
}

struct ChartReadings {
  Points2 places;
  Eigen::VectorXd values;
};

ChartReadings in_plane(const Surface& surface, const RecordedReadings& recording) {
  const PlaneMap map(surface);
  Points2 places(recording.positions.rows(), 2);
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    places.row(i) = snapped(map.place(recording.positions.row(i)));
  return {places, recording.readings};
}

/// Readings beside the tissue would pile up on its border: those farther out than the reach are
/// left out.
ChartReadings on_curved(const Surface& surface, const RecordedReadings& recording, double reach_m) {
  ChartReadings kept{Points2(recording.positions.rows(), 2),
                     Eigen::VectorXd(recording.readings.size())};
  const std::vector<bool> border = border_vertices(surface);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < recording.positions.rows(); ++i) {
    const Vec3 position = recording.positions.row(i);
    const SurfacePoint closest = surface.project(position);
    if (beyond_border_m(surface, border, position, closest) > reach_m) continue;
    kept.places.row(count) = snapped_place(surface, closest);
    kept.values[count++] = recording.readings[i];
  }
  kept.places.conservativeResize(count, 2);
  kept.values.conservativeResize(count);
  return kept;
}

}  // namespace

RecordedWorld::RecordedWorld(Surface surface, std::vector<RecordedReadings> recordings,
                             double reach_m)
    : surface_(std::move(surface)), reach_m_(reach_m) {
  require(!recordings.empty(), "RecordedWorld", "no recording",
          "was given: there must be at least one");
  require(std::isfinite(reach_m) && reach_m > 0.0, "RecordedWorld",
          "reach " + text_of(reach_m) + " m", "must be positive and finite");
  for (std::size_t number = 0; number < recordings.size(); ++number) {
    const RecordedReadings& recording = recordings[number];
    check(recording, "recording " + std::to_string(number + 1));
    const ChartReadings readings = surface_.is_planar() ? in_plane(surface_, recording)
                                                        : on_curved(surface_, recording, reach_m);
    fields_.emplace_back(readings.places, readings.values);
    travels_.push_back(mean_direction(recording.positions));
  }
  sorted_readings_ = recordings.front().readings;
  std::sort(sorted_readings_.begin(), sorted_readings_.end());
}

std::optional<Palpation> RecordedWorld::touch(const SurfacePoint& where, const Vec3& travel) const {
  require(travel.allFinite(), "RecordedWorld::touch", "the direction of travel", "must be finite");
  const Vec3 direction = travel.stableNormalized();
  const auto fits_worse = [&](const Vec3& a, const Vec3& b) {
    return a.dot(direction) < b.dot(direction);
  };
  const auto best =
      std::max_element(travels_.begin(), travels_.end(), fits_worse) - travels_.begin();
  const std::optional<double> reading = fields_[best].at(snapped_place(surface_, where), reach_m_);
  if (!reading) return std::nullopt;
  Palpation palpation;
  palpation.where = where;
  palpation.reading = *reading;
  palpation.travel =
      travels_[best].norm() > kOneWay ? Vec3(travels_[best].normalized()) : direction;
  return palpation;
}

Field RecordedWorld::map(double low) const {
  Field field(surface_.vertex_count());
  for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex) {
    field[vertex] = fields_.front()
                        .at(snapped_place(surface_, surface_.at_vertex(vertex)), reach_m_)
                        .value_or(low);
  }
  return field;
}

std::vector<bool> RecordedWorld::in_contact() const {
  std::vector<bool> contact(surface_.vertex_count());
  for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex) {
    const Vec2 place = snapped_place(surface_, surface_.at_vertex(vertex));
    const auto answers = [&](const ScatteredField& field) {
      return field.at(place, reach_m_).has_value();
    };
    contact[vertex] = std::all_of(fields_.begin(), fields_.end(), answers);
  }
  return contact;
}

double RecordedWorld::quantile(double q) const {
  require(q >= 0.0 && q <= 1.0, "RecordedWorld::quantile", text_of(q), "must be between 0 and 1");
  const double position = q * static_cast<double>(sorted_readings_.size() - 1);
  const auto below = static_cast<Eigen::Index>(position);
  const Eigen::Index above = std::min(below + 1, sorted_readings_.size() - 1);
  return std::lerp(sorted_readings_[below], sorted_readings_[above],
                   position - static_cast<double>(below));
}

}  // namespace palpation
