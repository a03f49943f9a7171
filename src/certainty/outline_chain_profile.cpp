// How a chain moves the profile, the tissue, and what readings are off by.
#include <algorithm>
#include <cmath>
#include <optional>

#include "certainty/outline_chain.h"

namespace palpation {
bool OutlineChain::move_profile(const OutlineProfile& profile, bool is_of_shape, Random& random) {
  const double change =
      log_profile_density(profile, *prior_) - log_profile_density(profile_, *prior_);
  if (!is_of_shape) return feels_profile(profile, change, random);
  consider_none();
  if (!takes(change + log_shape_density(outline_, profile) - log_shape_density(outline_, profile_),
             random))
    return false;
  profile_ = profile;
  law_ = law_of(profile, *prior_);
  return true;
}

/// As likely as not beforehand, as is proposed, and how it leans is drawn from the prior: so the
/// readings decide.
bool OutlineChain::switch_lean(Random& random) {
  OutlineProfile profile = profile_;
  profile.lean = random.uniform() < 0.5 ? std::nullopt : std::optional(draw_lean(random));
  return feels_profile(profile, 0.0, random);
}

/// Whether another profile is taken, where the rest of the log density changes by so much.
bool OutlineChain::feels_profile(const OutlineProfile& profile, double change, Random& random) {
  const ReadingLaw law = law_of(profile, *prior_);
  const bool keeps_shares = law.slope_per_m == law_.slope_per_m && law.lean == law_.lean &&
                            law.shoulder == law_.shoulder && law.skirt == law_.skirt;
  consider_none();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    Felt felt = felt_[i];
    if (!keeps_shares) felt.share = share_of(felt, law);
    consider(i, felt, law);
  }
  if (!takes(change, random)) return false;
  profile_ = profile;
  law_ = law;
  return true;
}

bool OutlineChain::move_tissue(int change, const Vec2& moved_m, Random& random) {
  const OutlineProfile before = profile_;
  profile_.moved_m[change] = moved_m;
  consider_none();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    if (std::ranges::count(prior_->epochs[epoch_of(i)], change) > 0)
      consider(i, felt_anew(place_of(i)), law_);
  }
  const bool taken =
      takes(log_profile_density(profile_, *prior_) - log_profile_density(before, *prior_), random);
  if (!taken) profile_ = before;
  return taken;
}

bool OutlineChain::move_tissue_and_nodes(int change, const Vec2& moved_m,
                                         const std::vector<Vec2>& places, Random& random) {
  OutlineProfile profile = profile_;
  profile.moved_m[change] = moved_m;
  return feels_elsewhere(profile, places, random);
}

/// Whether readings that were made elsewhere by this profile, and nodes that moved, are taken.
bool OutlineChain::feels_elsewhere(const OutlineProfile& profile, const std::vector<Vec2>& places,
                                   Random& random) {
  const OutlineNodes outline = outline_;
  const OutlineProfile before = profile_;
  const double log_prior_before = log_prior();
  outline_.place = places;
  pieces_ = OutlinePieces(outline_);
  profile_ = profile;
  bool taken = is_simple(outline_) && is_nested_as_before();
  if (taken) {
    consider_none();
    for (std::size_t i = 0; i < felt_.size(); ++i) consider(i, felt_anew(place_of(i)), law_);
    taken = takes(log_prior() - log_prior_before, random);
  }
  if (!taken) {
    outline_ = outline;
    pieces_ = OutlinePieces(outline_);
    profile_ = before;
  }
  return taken;
}

Eigen::VectorXd OutlineChain::redraw_residuals(Random& random, bool keeps_telling) {
  return residuals_.redraw(random, keeps_telling);
}

}  // namespace palpation
