#include "exploration/coarse_run.h"

#include <algorithm>

#include "geometry/settled_point.h"
#include "palpation/base/error.h"

namespace palpation {
std::vector<Palpation> as_planned(const Exploration& planner, const CoarseMesh& coarse,
                                  const Surface& surface, std::span<const Palpation> palpations) {
  const Surface& planned_on = planner.surface();
  std::vector<Palpation> planned(palpations.begin(), palpations.end());
  for (Palpation& palpation : planned) {
    const int vertex = surface.vertex_at(palpation.where);
    const auto found = std::ranges::lower_bound(coarse.vertices, vertex);
    const bool is_on_both = vertex >= 0 && found != coarse.vertices.end() && *found == vertex;
    palpation.where = is_on_both
                          ? planned_on.at_vertex(static_cast<int>(found - coarse.vertices.begin()))
                          : planned_on.project(surface.position(palpation.where));
  }
  return planned;
}

std::vector<Palpation> run_coarsely(Exploration& planner, const CoarseMesh& coarse,
                                    const Surface& surface, const Probe& probe,
                                    const std::function<void(const Tour&)>& after_batch,
                                    double way_step_m) {
  require(static_cast<std::size_t>(planner.surface().vertex_count()) == coarse.vertices.size(),
          "run_coarsely",
          "a planner on " + std::to_string(planner.surface().vertex_count()) + " vertices",
          "must work on the coarse mesh, which has " + std::to_string(coarse.vertices.size()));
  std::vector<Palpation> felt;
  std::optional<SurfacePoint> here;
  for (std::vector<int> stops = planner.next(); !stops.empty(); stops = planner.next()) {
    for (int& stop : stops) stop = coarse.vertices[static_cast<std::size_t>(stop)];
    Tour tour = travel(surface, stops, here, probe, way_step_m);
    for (Palpation& palpation : tour.palpations) {
      palpation.batch = planner.batch();
      palpation.where = settled_point(surface, palpation.where);
    }
    here = surface.at_vertex(stops.back());
    felt.insert(felt.end(), tour.palpations.begin(), tour.palpations.end());
    planner.record(as_planned(planner, coarse, surface, tour.palpations));
    if (after_batch) after_batch(tour);
  }
  return felt;
}

std::vector<int> on_coarse(const CoarseMesh& coarse, std::span<const int> vertices) {
  std::vector<int> both;
  for (std::size_t i = 0; i < coarse.vertices.size(); ++i) {
    if (std::binary_search(vertices.begin(), vertices.end(), coarse.vertices[i]))
      both.push_back(static_cast<int>(i));
  }
  return both;
}

}  // namespace palpation
