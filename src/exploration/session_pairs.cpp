#include "exploration/session_pairs.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace palpation {

std::vector<ReadingPair> pairs_of_session(const Surface& surface,
                                          std::span<const Palpation> palpations, int session) {
  std::vector<std::pair<Vec3, const Palpation*>> own, earlier;
  for (const Palpation& one : palpations) {
    if (!counts(one) || one.session > session) continue;
    (one.session == session ? own : earlier).emplace_back(surface.position(one.where), &one);
  }
  std::vector<std::pair<double, ReadingPair>> by_distance;
  for (const auto& [here, one] : own) {
    std::pair<double, ReadingPair> nearest{std::numeric_limits<double>::infinity(), {}};
    for (const auto& [there, other] : earlier) {
      const double distance2 = (there - here).squaredNorm();
      if (distance2 < nearest.first)
        nearest = {distance2, {one->reading, other->reading, other->session}};
    }
    by_distance.push_back(nearest);
  }
  std::ranges::stable_sort(by_distance, {}, [](const auto& pair) { return pair.first; });
  by_distance.resize((by_distance.size() + 1) / 2);
  std::vector<ReadingPair> pairs;
  for (const auto& [distance2, pair] : by_distance) pairs.push_back(pair);
  return pairs;
}

std::vector<SessionStart> later_sessions(std::span<const Palpation> palpations) {
  std::map<int, std::size_t> first_of;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (counts(palpations[i])) first_of.try_emplace(palpations[i].session, i);
  }
  std::vector<SessionStart> later;
  for (const auto& [session, number] : first_of) {
    if (session != first_of.begin()->first) later.push_back({session, number});
  }
  return later;
}

}  // namespace palpation
