#include "exploration/session_units.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "exploration/session_pairs.h"
#include "exploration/taken_back.h"
#include "readings/robust.h"

namespace palpation {
namespace {

constexpr std::size_t kFewest = 10;
constexpr double kOtherUnit = 3.0;  ///< times
constexpr double kAlike = 0.7;      ///< correlation: half of what one tells, the other does

/// Squares and products about means.
struct SharedSpread {
  double own = 0.0, other = 0.0, product = 0.0;
};

SharedSpread spread_within(std::span<const ReadingPair> pairs) {
  const auto count = static_cast<double>(pairs.size());
  double own = 0.0, other = 0.0;
  for (const ReadingPair& pair : pairs) {
    own += pair.own / count;
    other += pair.other / count;
  }
  SharedSpread spread;
  for (const ReadingPair& pair : pairs) {
    spread.own += (pair.own - own) * (pair.own - own);
    spread.other += (pair.other - other) * (pair.other - other);
    spread.product += (pair.own - own) * (pair.other - other);
  }
  return spread;
}

/// How many times as much the one rises as the other, both with errors: the ratio of their standard
/// deviations (the reduced major axis), within each other session, whose zero is its own.
std::optional<double> gain_of(std::vector<ReadingPair> pairs) {
  if (pairs.size() < kFewest) return std::nullopt;
  std::ranges::stable_sort(pairs, {}, &ReadingPair::session);
  SharedSpread all;
  for (auto first = pairs.begin(); first != pairs.end();) {
    const auto last = std::find_if(
        first, pairs.end(), [&](const ReadingPair& one) { return one.session != first->session; });
    const SharedSpread within = spread_within({first, last});
    all.own += within.own;
    all.other += within.other;
    all.product += within.product;
    first = last;
  }
  if (!(all.product > kAlike * std::sqrt(all.own) * std::sqrt(all.other))) return std::nullopt;
  return std::sqrt(all.own / all.other);
}

/// A reading that its gain leaves as it is: which one does not matter, the session's zero is free.
double middle_of(std::span<const Palpation> palpations, int session) {
  std::vector<double> readings;
  for (const Palpation& one : palpations) {
    if (counts(one) && one.session == session) readings.push_back(one.reading);
  }
  return median(readings);
}

}  // namespace

std::vector<Misfit> session_units(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Misfit> changes;
  for (const auto& [session, number] : later_sessions(palpations)) {
    const std::vector<Palpation> others =
        with_changes_taken_back(surface, {palpations.begin(), palpations.end()}, changes);
    const std::optional<double> gain = gain_of(pairs_of_session(surface, others, session));
    if (!gain || std::abs(std::log(*gain)) < std::log(kOtherUnit)) continue;
    changes.push_back({.kind = MisfitKind::Gain,
                       .from_batch = palpations[number].batch,
                       .number = number,
                       .session = session,
                       .amount = *gain - 1.0,
                       .low = middle_of(others, session)});
  }
  return changes;
}

}  // namespace palpation
