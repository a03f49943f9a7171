// Which parts of a boundary's inside stand out by a contrast of their own.
#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/detection.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/own_parts.h"

namespace palpation {
namespace {

/// That parts of one contrast are told apart.
constexpr double kFalseAlarms = 0.02;

}  // namespace

void EdgeBelief::name_parts(const OwnParts& parts) {
  const ProfileParameters& profile = most_likely().edge.profile;
  const Eigen::VectorXd variance = most_likely().profile_covariance().diagonal();
  const double strongest = profile_contrast(profile, 0);
  for (const OwnPart& part : parts) {
    PartContrast named{.where = surface_.at_vertex(part.summit)};
    if (part.plateau > 0) {
      named.of_strongest = profile_contrast(profile, part.plateau) / strongest;
      named.stddev = std::sqrt(variance[kCommonParameters + part.plateau - 1]) / strongest;
    }
    parts_.push_back(named);
  }
}

/// Each stretch of the boundary's inside, also of the first one's, which corrections may have
/// emptied; and what stands out of the healthy tissue beside it.
OwnParts EdgeBelief::parts_apart(const Field& field) const {
  const Field inside = depth_.cwiseMax(most_likely().distance_m);
  OwnParts parts = parts_inside(surface_, inside, field, profile_.low, most_likely().data);
  if (parts.empty()) return parts;
  for (const Misfit& misfit : misfits()) {
    if (misfit.kind == MisfitKind::WeakerPart && misfit.amount > 0.0)
      parts = with_part_at(std::move(parts), surface_, field, profile_.low, *misfit.where);
  }
  // Along a rim, where tissue is held and contact fades, healthy tissue rises, too.
  std::erase_if(parts, [&](const OwnPart& part) {
    const auto is_inside = [&](int vertex) { return depth_[vertex] >= 0.0; };
    return std::ranges::none_of(part.vertices, is_inside) && reaches_border(surface_, part);
  });
  return parts;
}

/// Without those that stand out by less than kLeastCut of the strongest's contrast, which go to
/// `weaker` where readings show them at all. Plateaus of their
/// own for those alone that readings tell from the strongest's: by Savage and Dickey's ratio, the
/// density of no difference before over after.
OwnParts EdgeBelief::told_apart(OwnParts parts, std::vector<Misfit>& weaker) const {
  const Fit& fit = most_likely();
  const Eigen::VectorXd variance = fit.profile_covariance().diagonal();
  const double needed = std::log(static_cast<double>(parts.size()) / kFalseAlarms);
  OwnParts told;
  int plateaus = 0;
  for (OwnPart& part : parts) {
    if (part.plateau > 0) {
      const Eigen::Index at = kCommonParameters + part.plateau - 1;
      const double higher = fit.edge.profile[at];
      const double contrast =
          profile_contrast(fit.edge.profile, part.plateau) / profile_contrast(fit.edge.profile, 0);
      const double evidence = 0.5 * std::log(variance[at] / fit.prior.variance[at]) +
                              0.5 * higher * higher / variance[at];
      if (contrast < kLeastCut) {
        const double amount = profile_contrast(fit.edge.profile, part.plateau);
        if (amount > kNeededToFind * std::sqrt(variance[at]))
          weaker.push_back({.kind = MisfitKind::WeakerPart,
                            .evidence = evidence,
                            .amount = amount,
                            .where = surface_.at_vertex(part.summit)});
        continue;
      }
      part.plateau = evidence > needed ? ++plateaus : 0;
      if (part.plateau > 0) part.contrast = contrast;
    }
    told.push_back(std::move(part));
  }
  return told;
}

}  // namespace palpation
