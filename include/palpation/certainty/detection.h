/// What would have been felt: the size of a tumour that readings which found nothing rule out.
#pragma once

#include <optional>
#include <span>

#include "palpation/geometry/surface.h"

namespace palpation {

/// A tumour that must not be missed, in the eyes of the readings: a disk whose readings stand out by a sigmoid of their depth.
struct Sought {
  double contrast_to_noise = 4.0;  ///< of its plateau, over the standard deviation of a reading; may be infinite
  double slope_per_m = 1200.0;     ///< of its edge
  double probability = 0.95;       ///< with which it would have been found
};

/// The least diameter of a disk that would have been found with that probability wherever on the tissue its centre is. Of the readings, at
/// `places`, those within the disk count. They are summed up with weights as large as their rise s, so the disk stands out by
/// contrast / noise sqrt(sum of s^2) standard deviations with a scatter of one; it is found where that exceeds kNeededToFind. Distances are
/// straight. Nothing where no disk up to twice the diameter of the tissue is found so surely. Throws InvalidInput unless contrast and slope
/// are positive and the probability lies in (0, 1).
std::optional<double> diameter_ruled_out_m(const Surface& surface, std::span<const Vec3> places, const Sought& sought);

/// Standard deviations: what is needed for three nats of evidence after the choice among all places and widths, which costs about seven:
/// z^2 / 2 = 10.
inline constexpr double kNeededToFind = 4.47;

}  // namespace palpation
