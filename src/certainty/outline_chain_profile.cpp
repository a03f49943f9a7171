// How a chain moves all but its nodes and cuts: the profile and the background.
#include <cmath>

#include "certainty/outline_chain.h"

namespace palpation {

bool OutlineChain::move_profile(const OutlineProfile& profile, bool is_of_shape, Random& random) {
  double change = log_profile_density(profile, *prior_) - log_profile_density(profile_, *prior_);
  const ReadingLaw law = law_of(profile, *prior_);
  fresh_.clear();
  if (is_of_shape) {
    change += log_shape_density(outline_, profile) - log_shape_density(outline_, profile_);
  } else {
    const bool keeps_shares = law.slope_per_m == law_.slope_per_m &&
                              law.shoulder == law_.shoulder && law.skirt == law_.skirt;
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      Felt felt = felt_[i];
      if (!keeps_shares) felt.share = share_at(law, felt.depth_m);
      felt.log_likelihood = likelihood_of(i, felt, law);
      change += consider(i, felt);
    }
  }
  if (!(std::log(random.uniform()) < change)) return false;
  profile_ = profile;
  law_ = law;
  keep_fresh();
  return true;
}

/// Which readings tell nothing is drawn first: those that do are normal.
void OutlineChain::draw_background(Random& random) {
  if (background_.is_none()) return;
  const auto count = static_cast<Eigen::Index>(felt_.size());
  Eigen::VectorXd off(count), precision(count);
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double square = readings_->variance[i] * law_.noise_square,
                 tells_nothing = law_.wild_density / std::exp(felt_[i].log_likelihood);
    off[row] = readings_->reading[i] - law_.low - law_.contrast[part_of(felt_[i])] * felt_[i].share;
    precision[row] = random.uniform() < tells_nothing ? 0.0 : 1.0 / square;
  }
  background_.draw(off, precision, random);
  for (std::size_t i = 0; i < felt_.size(); ++i)
    felt_[i].log_likelihood = likelihood_of(i, felt_[i], law_);
}

}  // namespace palpation
