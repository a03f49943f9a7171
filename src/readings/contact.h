/// Whether a probe keeps its contact over the tissue.
#pragma once

#include <optional>
#include <span>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Where tissue is tilted against the probe's way, the probe presses less and less: what it reads
/// of healthy tissue falls, and of a tumour's amplitude less and less is left.
struct FadingContact {
  Vec3 towards =
      Vec3::Zero();  ///< unit: where readings of healthy tissue fall, in the plane of their places
  double base_fall =
      0.0;  ///< by how much, from one end of the readings to the other, as a part of their contrast
  double amplitude_left = 1.0;  ///< greatest reading above healthy tissue's in the last third, over
                                ///< that in the best third
};

/// Healthy tissue's reading as a plane over the places: the one that three tenths of the tissue
/// read less than (a quantile regression, each reading for the part of the tissue that it stands
/// for), so that a tumour of up to half the tissue does not lift it. Contact fades where that plane
/// falls by 15 % of the contrast, which is the range of the readings about it (2nd to 98th
/// percentile), and by more than four times what chance may tilt it. Readings that are set aside do
/// not count; nothing with fewer than twenty, or where they are on one line.
std::optional<FadingContact> fading_contact(const Surface& surface,
                                            std::span<const Palpation> palpations);

}  // namespace palpation
