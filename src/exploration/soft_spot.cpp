#include "exploration/soft_spot.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "certainty/edge_data.h"
#include "exploration/background_search.h"
#include "palpation/readings/screening.h"

namespace palpation {
namespace {

/// Of the readings, at least, outside of a tumour.
constexpr std::size_t kOneIn = 10;

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

/// Whether the edge leaves out none of the tissue's border.
bool holds_border(const Known& known) {
  const Field& depth = known.boundary.edge->depth();
  return std::ranges::all_of(
      known.believed.belief.prior().surface().border_loops(), [&](const std::vector<int>& loop) {
        return std::ranges::all_of(loop, [&](int vertex) { return depth[vertex] > 0.0; });
      });
}

bool has_clear_edge(const Known& known) {
  return known.boundary.edge && known.boundary.edge->log_evidence() >
                                    log_evidence_without_edge(known.believed.belief) + surprising();
}

}  // namespace

bool is_all_but_a_patch(const Known& known) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      known.believed.palpations, [](const Palpation& one) { return counts(one); }));
  return kOneIn * outside_of(known).size() < count;
}

Known known_beside_soft_spot(const Surface& surface, const Model& model,
                             std::vector<Palpation>& felt, ConclusionCache& cache, bool is_last) {
  Known known = known_as_if_unchanged(surface, model, felt, cache, is_last);
  if (!known.boundary.edge || !is_all_but_a_patch(known) || !holds_border(known)) return known;
  std::vector<Palpation> rest = felt;
  for (const std::size_t i : outside_of(known)) rest[i].set_aside = kSoftSpot;
  Known beside = known_as_if_unchanged(surface, model, rest, cache, is_last);
  if (!has_clear_edge(beside) || is_all_but_a_patch(beside)) return known;
  felt = std::move(rest);
  return beside;
}

}  // namespace palpation
