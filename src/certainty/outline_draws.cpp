#include "certainty/outline_draws.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "certainty/outline_disagreement.h"
#include "certainty/outline_lines.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

/// Sweeps of a chain: before any counts, and in a round. Chains go on until they are alike; of
/// several rounds the first one does not count.
constexpr int kSettling = 400, kRound = 400, kMostRounds = 6;
constexpr double kAlike = 0.5;  ///< as chains of eight draws that know nothing of each other are

/// Chains that begin anew, and sweeps of each.
constexpr int kThatStay = 6, kSettlingToStay = 150, kSweepsToStay = 100;
/// Of a chain with a core, fewer draws that reach farther have not left yet.
constexpr double kFew = 0.1;

using Draws = std::vector<OutlineDraw>;

/// Places of the readings that tell nothing in more than half of them.
std::vector<SurfacePoint> unheeded_by(const Draws& draws, const OutlineReadings& readings) {
  std::vector<std::size_t> times(readings.places.size(), 0);
  for (const OutlineDraw& draw : draws) {
    for (const std::size_t reading : draw.unheeded) ++times[reading];
  }
  std::vector<SurfacePoint> places;
  for (std::size_t reading = 0; reading < readings.where.size(); ++reading) {
    if (2 * times[reading] > draws.size()) places.push_back(readings.where[reading]);
  }
  return places;
}

OutlineWalk walk_from(const OutlineStart& start, std::uint64_t seed) {
  return {start.readings, start.prior, start.outline, start.profile, seed};
}

bool encloses(const OutlineDraw& draw, double least_area_m2) {
  return enclosed_area(draw.outline) >= least_area_m2;
}

/// So many, evenly.
Draws thinned(const Draws& draws, int count) {
  Draws some;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    some.push_back(draws[i * draws.size() / static_cast<std::size_t>(count)]);
  return some;
}

/// So many, evenly, of those that enclose as much; of all, where none does.
Draws of_kind(const Draws& drawn, double least_area_m2, int count) {
  Draws some;
  std::ranges::copy_if(drawn, std::back_inserter(some),
                       [&](const OutlineDraw& draw) { return encloses(draw, least_area_m2); });
  if (some.empty()) some = drawn;
  return thinned(some, count);
}

/// A chain that has left its kind stays there, and tells nothing of where it came from: of several
/// that begin there, each as long as it is sure to stay.
Draws draws_that_stay(const OutlineStart& start, double least_area_m2, int count,
                      std::uint64_t seed) {
  std::vector<Draws> of_chain(kThatStay);
  for_ranges(kThatStay, 1, [&](int first, int last) {
    for (int chain = first; chain < last; ++chain) {
      OutlineWalk walk = walk_from(start, kThatStay * seed + static_cast<std::uint64_t>(chain));
      walk.settle(kSettlingToStay, kSettlingToStay / 2);
      of_chain[chain] = walk.draws(kSweepsToStay, kSweepsToStay);
    }
  });
  Draws all;
  for (Draws& some : of_chain) std::ranges::move(some, std::back_inserter(all));
  return of_kind(all, least_area_m2, count);
}

/// Those that enclose less have none; none has where few enclose as much.
void tell_no_core_of_less(double least_area_m2, Draws& draws) {
  const auto is_of_kind = [&](const OutlineDraw& draw) { return encloses(draw, least_area_m2); };
  const auto all = static_cast<double>(draws.size()),
             of_kind = static_cast<double>(std::ranges::count_if(draws, is_of_kind));
  for (OutlineDraw& draw : draws) {
    if (of_kind < kFew * all || !is_of_kind(draw)) draw.profile.core.reset();
  }
}

/// So many of each chain, one after the other.
OutlineDraws draws_until_alike(const std::array<const OutlineStart*, kChains>& starts, int each,
                               std::uint64_t seed, int most_rounds) {
  std::vector<OutlineWalk> walks;
  for (int chain = 0; chain < kChains; ++chain)
    walks.push_back(walk_from(*starts[chain], kChains * seed + static_cast<std::uint64_t>(chain)));
  std::array<Draws, kChains> of_chain;
  OutlineDraws result;
  for (int round = 0; round < most_rounds; ++round) {
    for_ranges(kChains, 1, [&](int first, int last) {
      for (int chain = first; chain < last; ++chain) {
        if (round == 0) walks[chain].settle(kSettling, kSettling / 2);
        if (round == 1) of_chain[chain].clear();
        std::ranges::move(walks[chain].draws(std::max(kRound, each), each),
                          std::back_inserter(of_chain[chain]));
      }
    });
    result.draws = thinned(of_chain[0], each);
    std::ranges::move(thinned(of_chain[1], each), std::back_inserter(result.draws));
    result.misfit.disagreement = disagreement_of(result.draws, starts[0]->outline.place);
    if (result.misfit.disagreement < kAlike) break;
  }
  return result;
}

/// As many of each as it is probable, an even number, and some.
OutlineDraws draws_of_two_kinds(const ChainStarts& starts, int each, std::uint64_t seed) {
  const int of_second = std::max(static_cast<int>(std::lround(starts.probability * each)), 1);
  const auto& [plain, cored] = starts.of;
  OutlineDraws result = draws_until_alike({&plain, &plain}, each - of_second, seed, kMostRounds);
  const Draws& plain_ones = result.draws;
  Draws of_core;
  if (2 * std::ranges::count_if(plain_ones, &OutlineDraw::has_plateau) < std::ssize(plain_ones)) {
    of_core = draws_that_stay(cored, starts.least_area_m2, 2 * of_second, seed);
  } else {
    of_core = draws_until_alike({&cored, &cored}, of_second, seed, 1).draws;
    tell_no_core_of_less(starts.least_area_m2, of_core);
  }
  // The first halves of both, and the second ones.
  const auto middle = of_core.begin() + of_second;
  result.draws.insert(result.draws.begin() + (each - of_second), of_core.begin(), middle);
  result.draws.insert(result.draws.end(), middle, of_core.end());
  result.misfit.disagreement = disagreement_of(result.draws, plain.outline.place);
  return result;
}

}  // namespace

OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed) {
  const int each = count / kChains;
  OutlineDraws drawn =
      starts.are_alike()
          ? draws_until_alike({&starts.of.front(), &starts.of.back()}, each, seed, kMostRounds)
          : draws_of_two_kinds(starts, each, seed);
  drawn.misfit.unheeded = unheeded_by(drawn.draws, starts.of.front().readings);
  return drawn;
}

}  // namespace palpation
