#include "certainty/outline_evidence.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "certainty/outline_core_odds.h"
#include "certainty/outline_pruning.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// One is off by five to ten nats.
constexpr int kWalks = 2;

}  // namespace

std::optional<OutlineEvidence> outline_evidence(const Belief& belief, const EdgeBelief& edge,
                                                const OutlineOptions& options,
                                                double profile_error) {
  if (!belief.prior().surface().has_chart()) return std::nullopt;
  std::optional<OutlineStart> start =
      outline_start(belief, belief.at_vertices(Part::Detrended).mean, edge, options, profile_error);
  if (!start) return std::nullopt;
  const OutlineStart begin = pruned(*std::move(start), options.seed);
  std::array<double, kWalks> log_densities{};
  for_ranges(kWalks, 1, [&](int first, int last) {
    for (int walk = first; walk < last; ++walk)
      log_densities[walk] =
          settled(begin, kWalks * options.seed + static_cast<std::uint64_t>(walk)).log_odds;
  });
  return OutlineEvidence{std::accumulate(log_densities.begin(), log_densities.end(), 0.0) / kWalks,
                         begin.readings.made};
}

}  // namespace palpation
