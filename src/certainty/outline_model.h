/// What outlines are taken for, and what readings say of one: the density that is sampled.
///
/// An outline is a closed polygon of nodes about a millimetre apart. Its direction turns at a node
/// as at the one before, but for corners, horns and necks, or is that of straight sides between
/// corners (turn_law.h); how wide the law of its turns is, and of which kind, is learned with the
/// outline. Pieces are about as long as each other. An outline is one of the lines that end where
/// they began, whose density is divided by how densely lines of such turns do: else outlines would
/// be the smoother beforehand the more loops there are. It is of what was felt: each loop holds a
/// reading, else it could leave the tissue, where none contradicts it. Depth is the signed distance
/// to the polygon, and a reading
///
///     low + contrast (high - low) / (1 + exp(-(bent(slope depth) + logit fraction)))
///         + background + noise
///
/// these two as outline_residuals.h has them. Unbent, that is equation 4 of Garg et al. 2016, zero
/// where the boundary is; bent(t) = sinh(k asinh t) / k (Jones and Pewsey 2009) is t near the
/// boundary and goes on as t^k, with a k for each side: a round top or a sharp one, the wide skirt
/// of something that lies deep or none. The slope may be the same on all sides, or another on each
/// (lean.h). Cuts take from the inside (outline_cut.h), and contrast may be less beyond a core
/// (outline_core.h).
#pragma once

#include <optional>
#include <vector>

#include "certainty/lean.h"
#include "certainty/outline_core.h"
#include "certainty/outline_nodes.h"
#include "certainty/outline_residuals.h"
#include "certainty/turn_law.h"
#include "palpation/base/random.h"
#include "palpation/certainty/misfit.h"

namespace palpation {

/// Of how large an outline is, the spread of its logarithm, where readings lie close to it.
inline constexpr double kLeastSizeLogSd = 0.3;

/// How far tissue moves, beforehand, on each axis.
inline constexpr double kMoveSd_m = 0.003;

/// How far readings were made from where they are said to be, along x and y: each by a way of its
/// own, and by one that lasts over some of them. No rows where places are known.
struct Wandering {
  struct Ways {
    Eigen::MatrixX2d terms{};  ///< a row each, of variance one beforehand
    double log_scale = 0.0;    ///< of metres
  };
  Ways of_each{};  ///< a row a reading
  Ways lasting{};  ///< ReadingWays::lasting times these

  bool is_none() const { return of_each.terms.rows() == 0; }
};

/// All but the nodes that is not known.
struct OutlineProfile {
  double low = 0.0;
  double high = 0.0;
  double log_slope = 0.0;      ///< of a slope per metre, in the tumour's middle
  std::optional<Lean> lean{};  ///< how that differs by side, seen from OutlinePrior::middle
  /// With which readings rise on inside, its shoulder, and fall on outside, its skirt.
  Vec2 log_powers = Vec2::Zero();
  Turns turns{};
  std::vector<double> log_spacing;   ///< of each loop's pieces, metres
  std::vector<double> log_contrast;  ///< of each part, the first one's 0
  std::optional<OutlineCore> core{};
  /// What is left of each change once it is taken back: later readings were made so much farther on
  /// than they are said to be, and are so many times as far from `low`. Of readings that come late
  /// the first number, by which they come later.
  std::vector<Vec2> moved_m{};
  std::vector<double> log_gain{};
  Wandering wandering{};
};

/// In reading units.
struct PlateauPrior {
  double low_sd = 1.0, high_sd = 1.0;
};

/// With a plateau the logarithm of a slope spreads about its median, whatever the tumour's size;
/// without one about that which is four fifths of the way up from the boundary where it is deepest.
struct SlopePrior {
  double log_sd = 0.5;
  double deepest_m = 0.005;
};

/// Medians and spreads, of all that is positive in logarithms.
struct OutlinePrior {
  OutlineProfile median;
  PlateauPrior plateaus{};
  SlopePrior slope{};
  ResidualPrior residuals{.wild_density = 1.0 / 6.0};
  double fraction = 0.5;                 ///< of the way from low to high, where the boundary is
  Vec2 middle = Vec2::Zero();            ///< of what was found first, and
  double radius_m = 0.005;               ///< how far from it a slope is nearly that of its side
  double size_log_sd = kLeastSizeLogSd;  ///< of how large what was found first is
  std::vector<MisfitKind> changes{};     ///< in time: what `moved_m` and `log_gain` may differ by
  std::vector<double> gain_log_sd{};     ///< of each
  /// The changes that readings of each were made after; of the first, none.
  std::vector<std::vector<int>> epochs{{}};
};

/// How readings come from depths, by a profile.
struct ReadingLaw {
  double low, slope_per_m, shoulder, skirt, logit_fraction;
  Lean lean;
  Vec2 middle;
  double radius_m;
  std::vector<double> contrast;  ///< of each part
  std::vector<double> gain;      ///< of readings of each epoch
  std::optional<OutlineCore> core{};
  Stadium in_core{};  ///< the core's places

  bool has_core(int part) const { return core && core->part == part; }
};
ReadingLaw law_of(const OutlineProfile& profile, const OutlinePrior& prior);

/// How many times as steep as in the middle.
double steepness_at(const ReadingLaw& law, const Vec2& place);
/// What share of its contrast tissue has at a depth.
double share_at(const ReadingLaw& law, double depth_m, double steepness = 1.0);
/// Of the part that has a core: there, where without one it would have this share at this depth.
/// What a core adds rises across its own edge where that lies within the outline, else across that.
double share_by_core(const ReadingLaw& law, const Vec2& place, double depth_m, double share);
/// The depth at which it has so much of it, which lies in (0, 1).
double depth_where(const ReadingLaw& law, double share, double steepness = 1.0);
/// By how much a reading was made elsewhere.
Vec2 way_of(const Wandering& wandering, const OutlineReadings& readings, Eigen::Index reading);

/// By how much the direction turns at a node, radians.
double turn_at(const OutlineNodes& outline, int node);
/// Of all turns at consecutive nodes of a loop, and of how unlike they are and those next to them
/// (turn_law.h).
double log_turns_density(const OutlineNodes& outline, int first, int count,
                         const OutlineProfile& profile);
/// Of a piece's length, as a density of its end's place.
double log_length_density(const Vec2& from, const Vec2& to, double log_spacing);
/// Of all nodes, given that loops close.
double log_shape_density(const OutlineNodes& outline, const OutlineProfile& profile);
/// Of which kind an outline is, beforehand.
LineKind draw_line_kind(Random& random);

/// Of the profile itself. Every second tumour is as steep on all sides; of which kind its lines
/// are counts nothing here, since kinds are proposed as often as they are so.
/// Two in three have a plateau, every second of these with the sigmoid's edge of equation 4; the
/// others are bent, rise as slowly as they are wide, and no law tells how high they would be if
/// they were wider.
double log_profile_density(const OutlineProfile& profile, const OutlinePrior& prior);
/// That one with such bends and such a slope is of the first kind.
double plateau_probability(const OutlineProfile& profile, const OutlinePrior& prior);

}  // namespace palpation
