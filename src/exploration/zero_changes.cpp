#include "exploration/zero_changes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "exploration/session_pairs.h"
#include "exploration/taken_back.h"
#include "exploration/zero_steps.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Readings that are looked at: a step shows in as many, and the cost grows with the third power.
constexpr std::size_t kMost = 200;
constexpr std::size_t kFewest = 12;

bool is_of_the_zero(const Belief& belief) {
  const std::optional<Misfit> change = changed_since(belief);
  return change && change->kind == MisfitKind::Zero;
}

bool may_show_steps(std::span<const std::size_t> numbers, const Belief& belief) {
  return numbers.size() >= kFewest && belief.noise_variance() > 0.0 && !belief.prior().has_slope();
}

/// The median by which a session's readings lie above those beside them.
double apart_by(const Surface& surface, std::span<const Palpation> palpations, int session) {
  std::vector<double> apart;
  for (const ReadingPair& pair : pairs_of_session(surface, palpations, session))
    apart.push_back(pair.own - pair.other);
  std::ranges::sort(apart);
  return apart[apart.size() / 2];
}

}  // namespace

std::vector<Misfit> session_zeros(const Surface& surface, std::span<const Palpation> palpations) {
  std::vector<Misfit> changes;
  for (const auto& [session, number] : later_sessions(palpations)) {
    // Those before it have zeros of their own: taken from all, what is left is this one's.
    std::vector<Palpation> others =
        with_changes_taken_back(surface, {palpations.begin(), palpations.end()}, changes);
    changes.push_back({.kind = MisfitKind::Zero,
                       .from_batch = palpations[number].batch,
                       .number = number,
                       .session = session,
                       .amount = apart_by(surface, others, session)});
  }
  return changes;
}

std::vector<Misfit> estimated_zeros(std::span<const Palpation> palpations, const Belief& belief,
                                    std::vector<Misfit> changes) {
  const std::vector<std::size_t> numbers = in_time(palpations, kMost);
  if (numbers.size() < kFewest) return changes;
  // What is left of them: of a large zero itself the prior would take a part.
  const std::vector<Palpation> without = with_changes_taken_back(
      belief.prior().surface(), {palpations.begin(), palpations.end()}, changes);
  const std::vector<Misfit> left = ZeroSteps(belief, without, numbers).estimated(changes);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i].amount += left[i].amount;
    changes[i].stddev = left[i].stddev;
  }
  return changes;
}

std::optional<Misfit> zero_or_tissue(std::span<const Palpation> palpations, const Belief& belief) {
  const std::vector<std::size_t> numbers = in_time(palpations, kMost);
  if (!may_show_steps(numbers, belief)) return std::nullopt;
  const ZeroSteps steps(belief, palpations, numbers);
  const std::optional<Misfit> step = steps.by_zero_or_tissue();
  if (!step) return std::nullopt;
  return steps.sharpened(steps.estimated({*step}));
}

std::vector<Misfit> zero_changes(std::span<const Palpation> palpations,
                                 const std::function<Belief(std::vector<Palpation>)>& believe,
                                 const Belief& first) {
  const std::vector<std::size_t> numbers = in_time(palpations, kMost);
  std::vector<Misfit> changes;
  Belief belief = first;
  while (changes.size() < kMostChanges && may_show_steps(numbers, belief)) {
    const ZeroSteps steps(belief, palpations, numbers);
    const std::optional<Misfit> more = steps.another(changes);
    if (!more || !is_of_the_zero(belief)) return steps.estimated(std::move(changes));
    changes.push_back(*more);
    changes = steps.estimated(std::move(changes));
    changes.back() = steps.sharpened(changes);
    belief = believe(with_changes_taken_back(first.prior().surface(),
                                             {palpations.begin(), palpations.end()}, changes));
  }
  return changes;
}

}  // namespace palpation
