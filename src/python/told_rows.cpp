#include "python/told_rows.h"

#include <cmath>
#include <utility>

#include "palpation/base/error.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

constexpr const char* kRecord = "Session.record";

int stop_count(const SessionState& state) {
  return state.plans.empty() ? 0 : static_cast<int>(state.plans.back().stops.size());
}

Points positions_of_vertices(const Surface& surface, const std::vector<int>& vertices) {
  Points positions(static_cast<Eigen::Index>(vertices.size()), 3);
  for (Eigen::Index row = 0; row < positions.rows(); ++row)
    positions.row(row) = surface.vertex(vertices[static_cast<std::size_t>(row)]).transpose();
  return positions;
}

Points positions_of_stops(const SessionState& state, const std::vector<int>& stops) {
  Points positions(static_cast<Eigen::Index>(stops.size()), 3);
  for (Eigen::Index row = 0; row < positions.rows(); ++row)
    positions.row(row) =
        state.plans.back().plan.stops[static_cast<std::size_t>(stops[row])].transpose();
  return positions;
}

/// As it was given: what lies off the tissue is kept and told.
Points given_positions(const Surface& surface, py::handle where) {
  const Argument argument{kRecord, "where"};
  if (!is_list_of_integers(where)) return points_of(where, argument);
  return positions_of_vertices(surface, indices_of(where, argument, surface.vertex_count()));
}

TouchKind touch_kind(const std::string& word) {
  if (word == "stop") return TouchKind::Stop;
  require(word == "way", kRecord, "kind '" + word + "'", "must be 'stop' or 'way'");
  return TouchKind::Way;
}

/// Where the readings were made, and which stops they answer, if that was said or follows.
struct Places {
  Points positions;
  std::vector<int> stops{};  ///< empty, or one each
};

Places places_of(const Surface& surface, const SessionState& state, const RecordGiven& given) {
  Places places;
  if (!given.stop.is_none())
    places.stops = stop_numbers(given.stop, {kRecord, "stop"}, stop_count(state));
  else if (given.where.is_none())
    places.stops = state.open_stops();
  places.positions = given.where.is_none() ? positions_of_stops(state, places.stops)
                                           : given_positions(surface, given.where);
  require(given.stop.is_none() ||
              places.positions.rows() == static_cast<Eigen::Index>(places.stops.size()),
          kRecord, "stop",
          "has " + std::to_string(places.stops.size()) + " numbers, must have one for each of " +
              std::to_string(places.positions.rows()) + " places");
  require(!given.where.is_none() || !places.stops.empty(), kRecord, "readings",
          "come when no stop is open: say `where` they were made");
  return places;
}

Vec3 unit(const Vec3& travel) {
  if (travel.isZero(0.0) || std::abs(travel.norm() - 1.0) <= 1e-12) return travel;
  return travel.stableNormalized();
}

void put_times(std::vector<Told>& told, const py::object& t) {
  if (t.is_none()) return;
  const Eigen::VectorXd times =
      spread_of(t, {kRecord, "t"}, static_cast<Eigen::Index>(told.size()), Missing::Welcome);
  for (std::size_t row = 0; row < told.size(); ++row)
    if (const double at = times[static_cast<Eigen::Index>(row)]; !std::isnan(at))
      told[row].made.t_s = at;
}

}  // namespace

std::vector<int> stop_numbers(py::handle given, const Argument& argument, int count) {
  const py::object several = py::module_::import("numpy").attr("atleast_1d")(given);
  return indices_of(several, argument, count);
}

std::vector<Told> told_rows(const Surface& surface, const SessionState& state,
                            const RecordGiven& given) {
  const TouchKind kind = touch_kind(given.kind);
  const Places places = places_of(surface, state, given);
  const Eigen::Index count = places.positions.rows();
  const Eigen::VectorXd values =
      numbers_of(given.felt.values, {kRecord, "readings"}, count, Missing::Welcome);
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(count, std::nan(""));
  if (!given.felt.noise_variance.is_none())
    variances =
        spread_of(given.felt.noise_variance, {kRecord, "noise_variance"}, count, Missing::Welcome);
  Points travel = Points::Zero(count, 3);
  if (!given.felt.travel.is_none()) travel = points_of(given.felt.travel, {kRecord, "travel"});
  require(travel.rows() == count, kRecord, "travel",
          "has " + std::to_string(travel.rows()) + " rows, must have " + std::to_string(count));

  std::vector<Told> told;
  for (Eigen::Index row = 0; row < count; ++row) {
    SessionReading made{.place = places.positions.row(row).transpose(),
                        .reading = values[row],
                        .noise_variance = variances[row],
                        .kind = std::isnan(values[row]) ? TouchKind::Missed : kind,
                        .travel = unit(travel.row(row).transpose())};
    if (!places.stops.empty()) made.stop = places.stops[static_cast<std::size_t>(row)];
    told.push_back({std::move(made), given.why});
  }
  put_times(told, given.t);
  return told;
}

std::vector<Told> told_rows(const Surface& surface, const Readings& readings, const py::object& t) {
  require_same_surface(surface, readings.surface, kRecord);
  std::vector<Told> told;
  for (const Palpation& one : readings.palpations) {
    require(one.set_aside.empty(), kRecord, "readings",
            "hold one that is set aside (" + one.set_aside + "): leave it out");
    told.push_back({{.place = surface.position(one.where),
                     .reading = one.reading,
                     .noise_variance = one.noise_variance,
                     .kind = one.kind,
                     .travel = one.travel}});
  }
  put_times(told, t);
  return told;
}

}  // namespace palpation::python
