/// Parts of a tumour that stand out each by its own contrast: where each is, and the field with all
/// of them as high as the strongest.
#pragma once

#include <span>
#include <vector>

#include "certainty/edge_fit.h"
#include "certainty/layout.h"

namespace palpation {

/// What stands out by less of the strongest's contrast is said, but not cut out.
inline constexpr double kLeastCut = 0.4;

struct OwnPart {
  std::vector<int> vertices;  ///< inside, rising
  int summit = 0;             ///< the highest of them
  double contrast = 1.0;      ///< of what the strongest part has
  int plateau = 0;            ///< of the profile's; 0: it is as high as the strongest
};

/// The strongest first; none: one contrast for all.
using OwnParts = std::vector<OwnPart>;

/// The parts of { depth >= 0 } that readings lie in, by the field's height above low, each with a
/// plateau of its own.
OwnParts parts_inside(const Surface& surface, const Field& depth, const Field& field, double low,
                      const EdgeData& data);

/// Around the summit next to a place, down to half its height, but for what is nearer to others;
/// rising. On another's slope the place is its own summit; empty where that is one of the others,
/// or no higher than low.
std::vector<int> around_summit(const Surface& surface, const Field& field, double low,
                               const SurfacePoint& place, std::span<const int> others);

/// With one more, around_summit, where that is not empty.
OwnParts with_part_at(OwnParts parts, const Surface& surface, const Field& field, double low,
                      const SurfacePoint& place);

bool reaches_border(const Surface& surface, const OwnPart& part);

/// The part that each vertex is nearest to: its number.
std::vector<int> nearest_parts(const Layout& layout, const OwnParts& parts);

/// The plateau of each place's nearest part.
std::vector<int> plateaus_of(const Surface& surface, const OwnParts& parts,
                             const std::vector<int>& nearest, std::span<const SurfacePoint> places);

/// The field with each part's surroundings stretched from low until it stands out as the strongest
/// does. Of what reaches `level` there, only what touches a part stays: stretched noise is none.
Field levelled(const Surface& surface, Field field, double low, double level, const OwnParts& parts,
               const std::vector<int>& nearest);

}  // namespace palpation
