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

/// The first halves of both, and the second ones.
Draws by_halves(const std::array<Draws, kChains>& of_chain) {
  Draws all;
  for (const std::ptrdiff_t half : {0, 1}) {
    for (const Draws& some : of_chain) {
      const std::ptrdiff_t count = std::ssize(some) / 2;
      all.insert(all.end(), some.begin() + half * count, some.begin() + (half + 1) * count);
    }
  }
  return all;
}

/// As many of each as it is probable, an even number, and some.
OutlineDraws draws_of_two_kinds(const ChainStarts& starts, int each, std::uint64_t seed) {
  const int of_second = 2 * std::max(static_cast<int>(std::lround(starts.probability * each)), 1);
  const std::array counts = {2 * each - of_second, of_second};
  std::array<Draws, kChains> of_chain;
  for_ranges(kChains, 1, [&](int first, int last) {
    for (int chain = first; chain < last; ++chain) {
      OutlineWalk walk =
          walk_from(starts.of[chain], kChains * seed + static_cast<std::uint64_t>(chain));
      walk.settle(2 * kSettling, kSettling / 2);
      of_chain[chain] = walk.draws(kSweeps, counts[chain]);
    }
  });
  auto& [plain, cored] = of_chain;
  if (2 * std::ranges::count_if(plain, &OutlineDraw::has_plateau) < counts.front())
    cored = draws_that_stay(starts.of.back(), starts.least_area_m2, of_second, seed);
  else
    tell_no_core_of_less(starts.least_area_m2, cored);
  return {.draws = by_halves(of_chain)};
}

OutlineDraws draws_of_one_kind(const ChainStarts& starts, int each, std::uint64_t seed) {
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
    result.misfit.disagreement = disagreement_of(result.draws);
    if (result.misfit.do_agree()) break;
  }
  return result;
}

}  // namespace

OutlineDraws draws_from(const ChainStarts& starts, int count, std::uint64_t seed) {
  OutlineDraws drawn =
      (starts.are_alike() ? draws_of_one_kind : draws_of_two_kinds)(starts, count / kChains, seed);
  drawn.misfit.unheeded = unheeded_by(drawn.draws, starts.of.front().readings);
  return drawn;
}

}  // namespace palpation
