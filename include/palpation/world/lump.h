/// What lies under tissue, and how its stiffness rises from its outline inwards.
#pragma once

#include <span>
#include <variant>
#include <vector>

#include "palpation/world/tumour.h"

namespace palpation {

/// The share of its contrast that a place d deep in a lump has, R being how deep the lump is at
/// most. Only the first is equation (4) of Garg et al. 2016.
///
/// | profile | share |
/// |---|---|
/// | Sigmoid | 1 / (1 + exp(-slope d - ln(f / (1 - f)))), f the level's fraction |
/// | Dome | the same times 0.7 + 0.3 (1 - (1 - d / R)^2): a top that is flat nowhere |
/// | Cone | (d + R) / 2R: no plateau on either side |
/// | Gauss | 2^(-r^2 / R^2), r = R - d |
/// | Hill | (1 + r^2 / z^2)^(-3/2), z = R / (2^(2/3) - 1)^(1/2): what is felt above a small sphere
/// at
///   the depth z (Boussinesq 1885); half of its height is at R |
enum class Profile { Sigmoid, Dome, Cone, Gauss, Hill };

/// `level_shift`: ln(f / (1 - f)).
double profile_share(Profile profile, double depth_m, double greatest_depth_m, double slope_per_m,
                     double level_shift);

struct Lump {
  Tumour outline;
  Profile profile = Profile::Sigmoid;
  double contrast = 1.0;  ///< of its plateau, in units of the model's high - low; positive
  /// The slope is this many times as large on the side that `steep_towards` points to, and as many
  /// times less on the other.
  double steeper = 1.0;
  Vec3 steep_towards = Vec3::Zero();
};

/// What healthy tissue adds to every reading. Heights are in units of high - low.
struct Wave {
  double height = 0.0;  ///< from trough to crest
  double length_m = 0.02;
  Vec3 direction = Vec3::UnitX();
  double phase_rad = 0.0;
};
/// A ridge along a line, height exp(-distance^2 / (2 half_width^2)).
struct Vessel {
  double height = 0.0;
  double half_width_m = 0.001;
  std::vector<Vec3> line_m{};
};
/// A stationary Gaussian field, by forty random waves.
struct Texture {
  double sd = 0.0;
  double length_m = 0.004;  ///< of a squared exponential covariance
  std::uint64_t seed = 1;
};
/// A plane: tissue that is thinner on one side, or a tool that is not upright.
struct Tilt {
  double height = 0.0;  ///< from one side of the tissue to the other, 0 half way
  Vec3 direction = Vec3::UnitX();
};
using Background = std::variant<Wave, Vessel, Texture, Tilt>;

/// At the vertices, all together. Throws InvalidInput unless heights and places are finite, lengths
/// and widths positive, directions not zero and lines of a point at least.
Field background_field(const Surface& surface, std::span<const Background> terms);

}  // namespace palpation
