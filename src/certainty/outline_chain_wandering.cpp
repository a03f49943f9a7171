// How a chain moves the ways by which places wander.
#include <cmath>

#include "certainty/outline_chain.h"

namespace palpation {

bool OutlineChain::wander(std::size_t reading, const Vec2& by, Random& random) {
  Wandering::Ways& ways = profile_.wandering.of_each;
  const auto row = static_cast<Eigen::Index>(reading);
  const double scale_m = std::exp(ways.log_scale) * readings_->ways.own[row];
  auto term = ways.terms.row(row);
  const Vec2 before = term.transpose(), after = before + by;
  consider_none();
  consider(reading, felt_anew(felt_[reading].place + scale_m * by), law_);
  const bool taken = takes(0.5 * (before.squaredNorm() - after.squaredNorm()), random);
  if (taken) term = after.transpose();
  return taken;
}

bool OutlineChain::wander_lasting(Eigen::Index term, const Vec2& by, Random& random) {
  Wandering::Ways& ways = profile_.wandering.lasting;
  const Vec2 before = ways.terms.row(term).transpose(), after = before + by,
             by_m = std::exp(ways.log_scale) * by;
  consider_none();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const double share = readings_->ways.lasting(static_cast<Eigen::Index>(i), term);
    if (share != 0.0) consider(i, felt_anew(felt_[i].place + share * by_m), law_);
  }
  const bool taken = takes(0.5 * (before.squaredNorm() - after.squaredNorm()), random);
  if (taken) ways.terms.row(term) = after.transpose();
  return taken;
}

bool OutlineChain::wander_with_nodes(const Wandering& wandering, const std::vector<Vec2>& places,
                                     Random& random) {
  OutlineProfile profile = profile_;
  profile.wandering = wandering;
  return feels_elsewhere(profile, places, random);
}

/// No reading feels it.
bool OutlineChain::rescale_ways(Wandering::Ways Wandering::*kind, double log_growth,
                                Random& random) {
  OutlineProfile profile = profile_;
  Wandering::Ways& ways = profile.wandering.*kind;
  ways.log_scale += log_growth;
  ways.terms *= std::exp(-log_growth);
  consider_none();
  const bool taken =
      takes(log_profile_density(profile, *prior_) - log_profile_density(profile_, *prior_) -
                static_cast<double>(ways.terms.size()) * log_growth,
            random);
  if (taken) profile_ = profile;
  return taken;
}

/// Given all others, a term is normal: places are sums of both kinds of ways, each of them so.
void OutlineChain::redraw_lasting_ways(Random& random) {
  auto& [of_each, lasting] = profile_.wandering;
  const double times = std::exp(lasting.log_scale - of_each.log_scale);
  for (Eigen::Index term = 0; term < lasting.terms.rows(); ++term) {
    const Eigen::VectorXd shares =
        times * readings_->ways.lasting.col(term).cwiseQuotient(readings_->ways.own);
    const double precision = 1.0 + shares.squaredNorm();
    const Eigen::RowVector2d mean = (shares.transpose() * of_each.terms - lasting.terms.row(term)) /
                                    precision,
                             normal(random.normal(), random.normal()),
                             by = mean + normal / std::sqrt(precision);
    lasting.terms.row(term) += by;
    of_each.terms -= shares * by;
  }
}

}  // namespace palpation
