#include "palpation/world/lump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/sigmoid.h"
#include "palpation/base/error.h"
#include "palpation/base/random.h"

namespace palpation {
namespace {

constexpr int kWavesOfTexture = 40;
constexpr double kDomed = 0.3;

void need(bool condition, const std::string& what, const std::string& rule) {
  require(condition, "background_field", what, rule);
}

double distance_to_piece(const Vec3& place, const Vec3& start, const Vec3& end) {
  const Vec3 along = end - start;
  const double length2 = along.squaredNorm();
  const double part =
      length2 > 0.0 ? std::clamp((place - start).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (place - start - part * along).norm();
}

void add(const Points& places, const Wave& wave, Field& field) {
  need(std::isfinite(wave.height) && std::isfinite(wave.phase_rad), "a wave's height or phase",
       "must be finite");
  need(std::isfinite(wave.length_m) && wave.length_m > 0.0,
       "a wave's length " + text_of(wave.length_m) + " m", "must be positive and finite");
  need(wave.direction.allFinite() && !wave.direction.isZero(0.0), "a wave's direction",
       "must be finite and not zero");
  const Vec3 turns = 2.0 * std::numbers::pi / wave.length_m * wave.direction.normalized();
  field.array() += 0.5 * wave.height * ((places * turns).array() + wave.phase_rad).sin();
}

void add(const Points& places, const Vessel& vessel, Field& field) {
  need(std::isfinite(vessel.height), "a vessel's height", "must be finite");
  need(std::isfinite(vessel.half_width_m) && vessel.half_width_m > 0.0,
       "a vessel's half width " + text_of(vessel.half_width_m) + " m",
       "must be positive and finite");
  need(!vessel.line_m.empty(), "a vessel's line", "must have a point at least");
  for (const Vec3& point : vessel.line_m)
    need(point.allFinite(), "a vessel's point", "must be finite");
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    const Vec3 place = places.row(i).transpose();
    double distance = (place - vessel.line_m.front()).norm();
    for (std::size_t piece = 1; piece < vessel.line_m.size(); ++piece)
      distance = std::min(distance,
                          distance_to_piece(place, vessel.line_m[piece - 1], vessel.line_m[piece]));
    field[i] += vessel.height * std::exp(-0.5 * std::pow(distance / vessel.half_width_m, 2));
  }
}

/// A squared exponential's spectrum is normal (Rahimi and Recht 2007).
void add(const Points& places, const Texture& texture, Field& field) {
  need(std::isfinite(texture.sd), "a texture's sd", "must be finite");
  need(std::isfinite(texture.length_m) && texture.length_m > 0.0,
       "a texture's length " + text_of(texture.length_m) + " m", "must be positive and finite");
  Random random(texture.seed);
  for (int wave = 0; wave < kWavesOfTexture; ++wave) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const double phase = 2.0 * std::numbers::pi * random.uniform();
    const Vec3 turns = Vec3(x, y, z) / texture.length_m;
    field.array() +=
        texture.sd * std::sqrt(2.0 / kWavesOfTexture) * ((places * turns).array() + phase).cos();
  }
}

void add(const Points& places, const Tilt& tilt, Field& field) {
  need(std::isfinite(tilt.height), "a tilt's height", "must be finite");
  need(tilt.direction.allFinite() && !tilt.direction.isZero(0.0), "a tilt's direction",
       "must be finite and not zero");
  const Eigen::VectorXd along = places * tilt.direction.normalized();
  const double least = along.minCoeff(), greatest = along.maxCoeff();
  if (greatest > least)
    field.array() += tilt.height * ((along.array() - least) / (greatest - least) - 0.5);
}

}  // namespace

double profile_share(Profile profile, double depth_m, double greatest_depth_m, double slope_per_m,
                     double level_shift) {
  const double above = greatest_depth_m - depth_m;  // 0 at the deepest place
  const double part = above / greatest_depth_m;
  switch (profile) {
    case Profile::Sigmoid:
      break;
    case Profile::Dome:
      return sigmoid(slope_per_m * depth_m + level_shift) *
             (1.0 - kDomed * std::pow(std::clamp(part, 0.0, 1.0), 2));
    case Profile::Cone:
      return std::clamp(1.0 - 0.5 * part, 0.0, 1.0);
    case Profile::Gauss:
      return std::exp2(-part * part);
    case Profile::Hill: {
      const double half = std::cbrt(4.0) - 1.0;
      return std::pow(1.0 + half * part * part, -1.5);
    }
  }
  return 1.0 / (1.0 + std::exp(-slope_per_m * depth_m - level_shift));
}

Field background_field(const Surface& surface, std::span<const Background> terms) {
  Field field = Field::Zero(surface.vertex_count());
  for (const Background& term : terms)
    std::visit([&](const auto& one) { add(surface.mesh().vertices, one, field); }, term);
  return field;
}

}  // namespace palpation
