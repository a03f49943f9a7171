#include "exploration/soft_spot.h"

#include <algorithm>
#include <cstddef>

#include "palpation/boundary/level_set.h"
#include "palpation/readings/screening.h"

namespace palpation {
namespace {

/// Of the readings, at least, outside of a tumour in tissue that waves.
constexpr std::size_t kOneIn = 10;
/// Of the tissue, at most, a soft spot: where stiff tissue is all around it, and anywhere.
constexpr double kMostEnclosed = 0.25;
constexpr double kMostAnywhere = 0.1;

/// Numbers of those that count and lie outside of the edge.
std::vector<std::size_t> outside_of(const Known& known) {
  const Surface& surface = known.believed.belief.prior().surface();
  const std::vector<Palpation>& palpations = known.believed.palpations;
  std::vector<std::size_t> outside;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i]) &&
        surface.interpolate(known.boundary.edge->depth(), palpations[i].where) < 0.0)
      outside.push_back(i);
  }
  return outside;
}

/// Whether the tissue has a border, of which the edge leaves nothing out.
bool holds_border(const Surface& surface, const Field& depth) {
  const auto is_inside = [&](int vertex) { return depth[vertex] > 0.0; };
  const std::vector<std::vector<int>>& loops = surface.border_loops();
  return !loops.empty() && std::ranges::all_of(loops, [&](const std::vector<int>& loop) {
    return std::ranges::all_of(loop, is_inside);
  });
}

bool leaves_out_a_spot(const Known& known) {
  if (!known.boundary.edge) return false;
  const Surface& surface = known.believed.belief.prior().surface();
  const Field& depth = known.boundary.edge->depth();
  const double outside = 1.0 - superlevel_area(surface, depth, 0.0) / surface.area();
  return outside < (holds_border(surface, depth) ? kMostEnclosed : kMostAnywhere);
}

}  // namespace

bool is_all_but_a_patch(const Known& known) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      known.believed.palpations, [](const Palpation& one) { return counts(one); }));
  return kOneIn * outside_of(known).size() < count;
}

Known known_beside_soft_spot(const Surface& surface, const Model& model,
                             std::vector<Palpation>& felt, ConclusionCache& cache, bool is_last) {
  if (model.level.is_of_edge()) {
    Known first = known_as_if_unchanged(surface, model, felt, cache, /*is_last=*/false);
    if (leaves_out_a_spot(first)) {
      for (const std::size_t i : outside_of(first)) felt[i].set_aside = kSoftSpot;
    } else if (!is_last) {
      return first;
    }
  }
  return known_as_if_unchanged(surface, model, felt, cache, is_last);
}

}  // namespace palpation
