/// A background that is taken back shows another edge, and that edge another background.
#pragma once

#include <optional>
#include <utility>

namespace palpation {

/// So often a background is found again about the edge that is seen without it, as long as readings
/// become more probable by what was found: its edge.log_evidence. `again`: what is found next, or
/// nothing.
inline constexpr int kRoundsOfBackground = 3;
template <typename Found, typename Again>
std::optional<Found> found_again(std::optional<Found> found, const Again& again) {
  for (int round = 0; found && round < kRoundsOfBackground; ++round) {
    std::optional<Found> next = again(*found);
    if (!next || !(next->edge.log_evidence > found->edge.log_evidence)) break;
    found = std::move(next);
  }
  return found;
}

/// The one by which readings are the more probable.
template <typename Found>
void keep_likelier(std::optional<Found> found, std::optional<Found>& best) {
  if (found && (!best || found->edge.log_evidence > best->edge.log_evidence))
    best = std::move(found);
}

}  // namespace palpation
