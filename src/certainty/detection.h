/// Whether a few readings stand out together, and what would have stood out: the size of a tumour
/// that readings which found nothing rule out.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "certainty/layout.h"

namespace palpation {

/// How far the readings of any disk stand out, in standard deviations of a normal: over disks of 4
/// to 20 mm around at most two thousand vertices, the greatest correlation r of the readings with
/// their rise s within the disk (below; 0 outside), as sqrt(-v log(1 - r^2)) (8 v + 1) / (8 v + 3),
/// v the number of readings less two (Wallace 1959): the scatter is learned from the same readings.
/// 0 where there are fewer than four of them, or they do not differ.
double greatest_excess(const Layout& layout, std::span<const Vec3> places,
                       std::span<const double> readings);

/// A tumour that must not be missed, in the eyes of the readings: a disk whose readings stand out
/// by a sigmoid of their depth.
struct Sought {
  double contrast_to_noise =
      4.0;  ///< of its plateau, over the standard deviation of a reading; may be infinite
  double slope_per_m = 1200.0;  ///< of its edge
  double probability = 0.95;    ///< with which it would have been found
};

/// The least diameter of a disk that would have been found with that probability at whichever of
/// the vertices its centre is. Of the readings, at `places`, those within the disk count. They are
/// summed up with weights as large as their rise s, so the disk stands out by contrast / noise
/// sqrt(sum of s^2) standard deviations with a scatter of one; it is found where the excess is
/// kNeededToFind. Places and distances are the layout's. Nothing where no disk up to twice the
/// diameter of the tissue is found so surely. Throws InvalidInput unless contrast and slope are
/// positive and the probability lies in (0, 1).
std::optional<double> diameter_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                                           const Sought& sought, std::span<const int> centres);
/// Wherever on the tissue its centre is.
std::optional<double> diameter_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                                           const Sought& sought);

/// The same centre by centre, at the vertices; the tissue's diameter, twice, where no disk would be
/// found, and 0 where there is no centre.
Field diameters_ruled_out_m(const Layout& layout, std::span<const Vec3> places,
                            const Sought& sought, std::span<const int> centres);

/// Where touches may go that rule out, and how many there may be.
struct FurtherTouches {
  std::span<const int> candidates;  ///< vertices
  std::size_t most = 0;
};

/// Vertices to touch, one after the other, until a disk of this diameter around any of the centres
/// would be found as surely as sought: always the one that takes away most of the squares of what
/// is lacking at the centres, the first of equals. Looks at two thousand of the centres where
/// something is lacking, and of the candidates that reach one, at most. None where nothing is
/// lacking; fewer than needed where `most` are not enough, or no candidate helps. Throws as
/// diameter_ruled_out_m.
std::vector<int> touches_to_rule_out(const Layout& layout, std::span<const Vec3> places,
                                     const Sought& sought, double diameter_m,
                                     std::span<const int> centres, const FurtherTouches& further);

/// To which radii are looked for.
inline constexpr double kRadiusResolution_m = 1e-5;

/// Standard deviations: what is needed for three nats of evidence after the choice among all places
/// and widths, which costs about seven: z^2 / 2 = 10.
inline constexpr double kNeededToFind = 4.47;

}  // namespace palpation
