#include "certainty/outline_draws.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "certainty/outline_lines.h"
#include "palpation/base/parallel.h"

namespace palpation {
namespace {

constexpr int kSettling = 400, kSweeps = 800;
/// As often chains that do not agree go on, each time for as long as before.
constexpr int kMostRounds = 3;

/// Chains of a kind that is left, and sweeps of each.
constexpr int kOfKind = 6, kSettlingOfKind = 150, kSweepsOfKind = 100;
/// Fewer of all draws with a core have not left their kind yet.
constexpr double kFew = 0.05;

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

OutlineWalk walk_from(const OutlineStart& start, std::uint64_t seed) {
  return {start.readings, start.prior, start.outline, start.profile, seed};
}

bool encloses(const OutlineDraw& draw, double least_area_m2) {
  return enclosed_area(draw.outline) >= least_area_m2;
}

/// So many, evenly, of those that enclose as much; of all, where none does.
Draws of_kind(const Draws& drawn, double least_area_m2, int count) {
  Draws some;
  std::ranges::copy_if(drawn, std::back_inserter(some),
                       [&](const OutlineDraw& draw) { return encloses(draw, least_area_m2); });
  if (some.empty()) some = drawn;
  Draws kept;
  for (int i = 0; i < count; ++i)
    kept.push_back(some[i * some.size() / static_cast<std::size_t>(count)]);
  return kept;
}

/// A chain that left its kind would stay there, and tell nothing of where it came from: of the
/// second kind there are several, each as long as it is sure to stay.
OutlineDraws draws_where_one_is_left(const ChainStarts& starts, int each, std::uint64_t seed) {
  std::vector<Draws> of_chain(1 + kOfKind);
  for_ranges(1 + kOfKind, 1, [&](int first, int last) {
    for (int chain = first; chain < last; ++chain) {
      const bool is_first = chain == 0;
      OutlineWalk walk = walk_from(is_first ? starts.of.front() : starts.of.back(),
                                   (1 + kOfKind) * seed + static_cast<std::uint64_t>(chain));
      const int settling = is_first ? kSettling : kSettlingOfKind;
      walk.settle(settling, settling / 2);
      of_chain[chain] =
          is_first ? walk.draws(kSweeps, each) : walk.draws(kSweepsOfKind, kSweepsOfKind);
    }
  });
  Draws of_second;
  for (int chain = 1; chain <= kOfKind; ++chain)
    std::ranges::move(of_chain[chain], std::back_inserter(of_second));
  OutlineDraws result{.draws = std::move(of_chain.front())};
  std::ranges::move(of_kind(of_second, starts.least_area_m2, each),
                    std::back_inserter(result.draws));
  return result;
}

/// Each as long as it takes to come to the other's kind, where that is as probable: then it has no
/// core, whatever it is drawn with.
OutlineDraws draws_of_two_kinds(const ChainStarts& starts, int each, std::uint64_t seed) {
  std::vector<Draws> of_chain(kChains);
  for_ranges(kChains, 1, [&](int first, int last) {
    for (int chain = first; chain < last; ++chain) {
      OutlineWalk walk =
          walk_from(starts.of[chain], kChains * seed + static_cast<std::uint64_t>(chain));
      walk.settle(2 * kSettling, kSettling / 2);
      of_chain[chain] = walk.draws(kSweeps, each);
    }
  });
  const auto is_of_second = [&](const OutlineDraw& draw) {
    return encloses(draw, starts.least_area_m2);
  };
  Draws& of_second = of_chain.back();
  const auto count = static_cast<double>(std::ranges::count_if(of_second, is_of_second));
  const bool are_few = count < kFew * kChains * each;
  for (OutlineDraw& draw : of_second) {
    if (are_few || !is_of_second(draw)) draw.profile.core.reset();
  }
  OutlineDraws result{.draws = std::move(of_chain.front())};
  std::ranges::move(of_second, std::back_inserter(result.draws));
  return result;
}

}  // namespace

OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed) {
  const int each = count / kChains;
  if (!starts.are_alike())
    return starts.is_left ? draws_where_one_is_left(starts, each, seed)
                          : draws_of_two_kinds(starts, each, seed);
  std::vector<OutlineWalk> walks;
  for (int chain = 0; chain < kChains; ++chain)
    walks.push_back(
        walk_from(starts.of[chain], kChains * seed + static_cast<std::uint64_t>(chain)));
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
    result.disagreement = disagreement_of(result.draws);
    if (result.do_agree()) break;
  }
  return result;
}

}  // namespace palpation
