#include "results/tour.h"

#include <Eigen/Geometry>
#include <map>

#include "palpation/io/csv.h"

namespace palpation::results {
namespace {

/// The places on the way to each stop, by the stop's place in the tour; in the mesh's frame.
std::map<int, std::vector<Vec3>> legs_of(const Run& run) {
  std::map<int, std::vector<Vec3>> legs;
  const std::filesystem::path path = run.folder / "path.csv";
  if (!std::filesystem::exists(path)) return legs;
  const CsvTable table = read_csv(path);
  const std::optional<std::size_t> leg = find_column(table, "leg");
  for (std::size_t row = 0; leg && row < table.row_count(); ++row)
    legs[static_cast<int>(finite_number_at(table, row, *leg))].push_back(
        run.in_mesh(place_at(table, row)));
  return legs;
}

}  // namespace

nlohmann::json tours_of(const Run& run, const PlaceGrid& grid) {
  // A plan's path leads to stops that are not touched yet.
  const std::map<int, std::vector<Vec3>> legs =
      run.next_stops.empty() ? legs_of(run) : std::map<int, std::vector<Vec3>>();
  std::map<int, std::vector<Vec3>> tours;
  const Touch* last = nullptr;
  int stop = 0;
  for (const Touch& touch : run.touches) {
    if (touch.kind == "way") continue;
    if (last != nullptr) {
      std::vector<Vec3>& tour = tours[touch.batch];
      Vec3 here = last->place;
      if (const auto leg = legs.find(stop); leg != legs.end()) {
        for (const Vec3& place : leg->second) {
          tour.insert(tour.end(), {here, place});
          here = place;
        }
      }
      tour.insert(tour.end(), {here, touch.place});
    }
    last = &touch;
    ++stop;
  }
  nlohmann::json texts = nlohmann::json::object();
  for (const auto& [batch, tour] : tours) texts[std::to_string(batch)] = grid.text(tour);
  return texts;
}

}  // namespace palpation::results
