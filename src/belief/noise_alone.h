/// The readings as independent draws around a constant, or around a plane where the prior has a
/// slope: what a field must explain better. All of them, also those of one site, whose scatter the
/// field has to explain as well.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "belief/sites.h"

namespace palpation {

struct NoiseAlone {
  double log_likelihood = -std::numeric_limits<double>::infinity();
  std::vector<double> residuals;  // of merged readings, up to a constant
};

/// `readings`: merged, one a site. Of one variance, whatever is known of each.
NoiseAlone noise_alone(const Prior& prior, std::span<const Site> sites,
                       const std::vector<double>& readings);

}  // namespace palpation
