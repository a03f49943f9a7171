// How a chain moves what is cut from its outline.
#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/outline_chain.h"

namespace palpation {

/// Of the readings' part of the density; the rest has changed by `change`. Few readings lie any
/// deeper or less deep for a cut.
bool OutlineChain::try_cut(int which, const OutlineCut& cut, double change, Random& random) {
  const OutlineCut before = std::exchange(taken_.cuts[which], cut);
  const Stadium stadium_before = std::exchange(taken_.stadiums[which], cut.stadium());
  consider_none();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const auto& [place, nearest, inside, depth_m, share] = felt_[i];
    if (depth_of(felt_[i]) != depth_m) consider(i, felt_at(place, nearest, inside), law_);
  }
  const bool taken = takes(change, random);
  if (!taken) {
    taken_.cuts[which] = before;
    taken_.stadiums[which] = stadium_before;
  }
  return taken;
}

/// Fresh ones come from their prior but for the anchor: the rest of the density cancels.
bool OutlineChain::switch_cut(int which, Random& random) {
  if (felt_.empty()) return false;
  const auto anchor_ratio = [&](std::size_t anchor) {
    const double share = taken_.anchors[anchor] - (anchor > 0 ? taken_.anchors[anchor - 1] : 0.0);
    return -std::log(static_cast<double>(felt_.size()) * share);
  };
  const OutlineCut& now = taken_.cuts[which];
  if (now.is_present) return try_cut(which, {}, -anchor_ratio(now.anchor), random);
  const auto found = std::ranges::upper_bound(taken_.anchors, random.uniform());
  const auto anchor = std::min<std::size_t>(found - taken_.anchors.begin(), felt_.size() - 1);
  return try_cut(which, drawn_cut(static_cast<int>(anchor), readings_->places[anchor], random),
                 anchor_ratio(anchor), random);
}

bool OutlineChain::move_cut(int which, const OutlineCut& cut, Random& random) {
  const double density = log_cut_density(cut);
  return std::isfinite(density) &&
         try_cut(which, cut, density - log_cut_density(taken_.cuts[which]), random);
}

void OutlineChain::anchor_anew(int which, Random& random) {
  OutlineCut& cut = taken_.cuts[which];
  const double radius = std::exp(cut.log_radius);
  const Vec2 middle = cut.anchor_place + radius * cut.offset;
  std::vector<int> within;
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    if ((readings_->places[i] - middle).squaredNorm() <= radius * radius)
      within.push_back(static_cast<int>(i));
  }
  if (within.empty()) return;
  cut.anchor = within[random.below(static_cast<int>(within.size()))];
  cut.anchor_place = readings_->places[cut.anchor];
  cut.offset = (middle - cut.anchor_place) / radius;
}

}  // namespace palpation
