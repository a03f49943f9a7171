#include "certainty/outline_draws.h"

#include <cmath>
#include <utility>

#include "certainty/outline_lines.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kSettling = 400, kSweeps = 800;
/// As often chains that do not agree go on, each time for as long as before.
constexpr int kMostRounds = 3;

using Draws = std::vector<OutlineDraw>;

/// Between the halves of draws, which are of two chains.
double disagreement_of(const Draws& draws) {
  const auto half = draws.size() / 2;
  double mean[2] = {0.0, 0.0}, square = 0.0;
  for (std::size_t i = 0; i < draws.size(); ++i)
    mean[i / half] += enclosed_area(draws[i].outline) / static_cast<double>(half);
  for (std::size_t i = 0; i < draws.size(); ++i)
    square += std::pow(enclosed_area(draws[i].outline) - mean[i / half], 2);
  const double sd = std::sqrt(square / static_cast<double>(draws.size()));
  return sd > 0.0 ? std::abs(mean[0] - mean[1]) / sd : 0.0;
}

}  // namespace

OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed) {
  const bool are_alike =
      starts.front().profile.core.has_value() == starts.back().profile.core.has_value();
  std::vector<OutlineWalk> walks;
  for (int chain = 0; chain < kChains; ++chain) {
    const OutlineStart& start = starts[chain];
    walks.emplace_back(start.readings, start.prior, start.outline, start.profile,
                       kChains * seed + static_cast<std::uint64_t>(chain));
  }
  const int each = count / kChains;
  OutlineDraws result;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Draws> of_chain(kChains);
    for_ranges(kChains, 1, [&](int first, int last) {
      for (int chain = first; chain < last; ++chain) {
        walks[chain].settle(kSettling, round == 0 ? kSettling / 2 : 0);
        of_chain[chain] = walks[chain].draws(kSweeps, each);
      }
    });
    result.draws = std::move(of_chain[0]);
    for (OutlineDraw& draw : of_chain[1]) result.draws.push_back(std::move(draw));
    if (!are_alike) break;
    result.disagreement = disagreement_of(result.draws);
    if (result.do_agree()) break;
  }
  return result;
}

}  // namespace palpation
