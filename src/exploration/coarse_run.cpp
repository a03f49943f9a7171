#include "exploration/coarse_run.h"

#include <algorithm>

#include "palpation/base/error.h"

namespace palpation {
namespace {

/// The same palpation where the planner knows it: at a vertex if it was made at one that both have,
/// else at the closest place.
Palpation as_planned(const Exploration& planner, const CoarseMesh& coarse, const Surface& surface,
                     Palpation palpation) {
  const Surface& planned_on = planner.surface();
  const int vertex = surface.vertex_at(palpation.where);
  const auto found = std::ranges::lower_bound(coarse.vertices, vertex);
  const bool is_on_both = vertex >= 0 && found != coarse.vertices.end() && *found == vertex;
  palpation.where = is_on_both
                        ? planned_on.at_vertex(static_cast<int>(found - coarse.vertices.begin()))
                        : planned_on.project(surface.position(palpation.where));
  return palpation;
}

}  // namespace

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
    if (way_step_m == 0.0) planner.foresee();
    for (int& stop : stops) stop = coarse.vertices[static_cast<std::size_t>(stop)];
    Tour tour = travel(surface, stops, here, probe, way_step_m);
    std::vector<Palpation> planned;
    for (Palpation& palpation : tour.palpations) {
      palpation.batch = planner.batch();
      planned.push_back(as_planned(planner, coarse, surface, palpation));
    }
    here = surface.at_vertex(stops.back());
    felt.insert(felt.end(), tour.palpations.begin(), tour.palpations.end());
    planner.record(planned);
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
