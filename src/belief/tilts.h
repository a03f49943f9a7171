/// What a slope of one standard deviation adds at places. Private to this folder.
#pragma once

#include <Eigen/Core>
#include <span>

#include "belief/sites.h"
#include "palpation/belief/prior.h"

namespace palpation {

using Tilts = Eigen::Matrix<double, Eigen::Dynamic, 3>;

inline Tilts tilts_of(const Prior& prior, std::span<const Site> sites) {
  Tilts tilts(sites.size(), 3);
  for (std::size_t i = 0; i < sites.size(); ++i)
    tilts.row(i) = prior.tilt(sites[i].place.coordinates);
  return tilts;
}

}  // namespace palpation
