#include "experiments/recorded.h"

#include <algorithm>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/csv.h"
#include "palpation/io/recording.h"

namespace palpation::tool {
namespace {

constexpr double kCell_m =
    0.0007;  // of the mesh around a recording: half the distance of its closest rows
constexpr std::size_t kMostBelieved = 300;  // of a dense recording's readings

Surface tissue_around(std::span<const Vec3> places) {
  Vec2 least = places.front().head<2>(), most = least;
  for (const Vec3& place : places) {
    least = least.cwiseMin(place.head<2>());
    most = most.cwiseMax(place.head<2>());
  }
  const Vec2 size = most - least;
  Random unused(0);
  return Surface(make_plane({.size_m = size,
                             .columns = static_cast<int>(std::ceil(size.x() / kCell_m)) + 1,
                             .rows = static_cast<int>(std::ceil(size.y() / kCell_m)) + 1,
                             .corner_m = least},
                            unused));
}

}  // namespace

std::filesystem::path file_of(const ExperimentArguments& arguments, const std::string& name) {
  return arguments.material.recordings / (name + ".csv");
}

Recorded recorded(const ExperimentArguments& arguments, const std::string& name) {
  const CsvTable table = read_csv(file_of(arguments, name));
  const std::size_t x = column_index(table, "x"), y = column_index(table, "y"),
                    reading = column_index(table, "reading"), row = column_index(table, "row"),
                    index = column_index(table, "index");
  std::vector<Vec3> places;
  std::vector<double> readings;
  std::vector<int> rows, indices;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    const std::optional<double> felt = number_at(table, i, reading);
    if (!felt || std::isnan(*felt)) continue;
    places.emplace_back(finite_number_at(table, i, x), finite_number_at(table, i, y), 0.0);
    readings.push_back(*felt);
    rows.push_back(static_cast<int>(finite_number_at(table, i, row)));
    indices.push_back(static_cast<int>(finite_number_at(table, i, index)));
  }
  if (places.empty()) throw IoError(table.name() + ": no row holds a reading");
  double forward_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (rows[i] == rows[i - 1]) forward_m += places[i].y() - places[i - 1].y();
  }
  Recorded made{name, tissue_around(places), {}, indices, rows, places};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Palpation palpation;
    palpation.where = made.tissue.project(places[i]);
    palpation.reading = readings[i];
    palpation.travel = forward_m > 0.0 ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
    made.palpations.push_back(palpation);
  }
  return made;
}
std::vector<Palpation> thinned(std::span<const Palpation> palpations) {
  std::vector<Palpation> used;
  for (const Palpation& palpation : palpations) {
    if (palpation.set_aside.empty()) used.push_back(palpation);
  }
  const std::size_t stride = (used.size() + kMostBelieved - 1) / kMostBelieved;
  std::vector<Palpation> kept;
  for (std::size_t i = 0; i < used.size(); i += stride) kept.push_back(used[i]);
  return kept;
}

std::vector<Vec3> points_of(const Surface& surface, const Field& field, double level) {
  std::vector<Vec3> points;
  for (const LevelLoop& loop : level_loops(surface, field, level)) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      if (!loop.on_border[i]) points.push_back(surface.position(loop.points[i]));
    }
  }
  return points;
}

}  // namespace palpation::tool
