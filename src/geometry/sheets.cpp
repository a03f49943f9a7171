// The phantoms' shapes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "palpation/base/error.h"
#include "palpation/geometry/make_phantom.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;

void require_length(const char* function, const char* name, double length_m) {
  require(std::isfinite(length_m) && length_m > 0.0, function,
          std::string(name) + " = " + text_of(length_m), "must be positive and finite");
}

void require_size(const char* function, const Vec2& size_m) {
  require_length(function, "size_m.x", size_m.x());
  require_length(function, "size_m.y", size_m.y());
}

/// The S-bend's cross-section: where it is after a length s, and which way its outside looks there.
struct Section {
  Vec2 place, normal;  // x, z
};

Section fold(const FoldedOptions& options, double s) {
  const double flank = options.flank_m, radius = 0.5 * options.gap_m, bend = kPi * radius;
  if (s <= flank) return {{s, 0.0}, {0.0, 1.0}};
  s -= flank;
  if (s <= bend) {
    const double angle = s / radius;
    return {{flank + radius * std::sin(angle), radius - radius * std::cos(angle)},
            {-std::sin(angle), std::cos(angle)}};
  }
  s -= bend;
  if (s <= flank) return {{flank - s, 2.0 * radius}, {0.0, -1.0}};
  s -= flank;
  if (s <= bend) {
    const double angle = s / radius;
    return {{-radius * std::sin(angle), 3.0 * radius - radius * std::cos(angle)},
            {-std::sin(angle), -std::cos(angle)}};
  }
  return {{s - bend, 4.0 * radius}, {0.0, 1.0}};
}

}  // namespace

Sheet cylinder_sheet(const CylinderOptions& options) {
  require_length("cylinder_sheet", "radius_m", options.radius_m);
  require_size("cylinder_sheet", options.size_m);
  require(options.size_m.x() < 2.0 * kPi * options.radius_m, "cylinder_sheet",
          "size_m.x = " + text_of(options.size_m.x()),
          "must be less than once around, " + text_of(2.0 * kPi * options.radius_m));
  const double radius = options.radius_m, middle = 0.5 * options.size_m.x();
  const auto angle = [=](const Vec2& p) { return (p.x() - middle) / radius; };
  return {
      .size_m = options.size_m,
      .position =
          [=](const Vec2& p) {
            return Vec3(middle + radius * std::sin(angle(p)), p.y(),
                        radius * (std::cos(angle(p)) - 1.0));
          },
      .normal = [=](const Vec2& p) { return Vec3(std::sin(angle(p)), 0.0, std::cos(angle(p))); },
      .unrolled = [](const Vec2& p) { return p; }};
}

Sheet dome_sheet(const DomeOptions& options) {
  require_length("dome_sheet", "radius_m", options.radius_m);
  require_length("dome_sheet", "reach_m", options.reach_m);
  require(options.reach_m < kPi * options.radius_m, "dome_sheet",
          "reach_m = " + text_of(options.reach_m),
          "must not come to the other pole, " + text_of(kPi * options.radius_m));
  const double radius = options.radius_m;
  const auto normal = [=](const Vec2& p) -> Vec3 {
    const double reach = p.norm();
    if (reach == 0.0) return Vec3::UnitZ();
    const Vec2 level = std::sin(reach / radius) / reach * p;
    return {level.x(), level.y(), std::cos(reach / radius)};
  };
  return {.corner_m = Vec2::Constant(-options.reach_m),
          .size_m = Vec2::Constant(2.0 * options.reach_m),
          .is_round = true,
          .position = [=](const Vec2& p) -> Vec3 { return radius * (normal(p) - Vec3::UnitZ()); },
          .normal = normal,
          .unrolled = {}};
}

Sheet saddle_sheet(const SaddleOptions& options) {
  require_length("saddle_sheet", "radius_m", options.radius_m);
  require_size("saddle_sheet", options.size_m);
  const double radius = options.radius_m;
  return {.corner_m = -0.5 * options.size_m,
          .size_m = options.size_m,
          .position =
              [=](const Vec2& p) {
                return Vec3(p.x(), p.y(), (p.x() * p.x() - p.y() * p.y()) / (2.0 * radius));
              },
          .normal = [=](const Vec2& p) -> Vec3 {
            return Vec3(-p.x() / radius, p.y() / radius, 1.0).normalized();
          },
          .unrolled = {}};
}

Sheet wave_sheet(const WaveOptions& options) {
  require_length("wave_sheet", "amplitude_m", options.amplitude_m);
  require_length("wave_sheet", "wavelength_m", options.wavelength_m);
  require_size("wave_sheet", options.size_m);
  const double amplitude = options.amplitude_m, rate = 2.0 * kPi / options.wavelength_m,
               steepest = amplitude * rate;
  require(steepest <= 100.0, "wave_sheet", "amplitude_m = " + text_of(amplitude),
          "must be at most 16 times wavelength_m");
  // Length of the sine curve: the integral of sqrt(1 + a^2 cos^2 u) = sqrt(1 + a^2) sqrt(1 - k^2
  // sin^2 u), k^2 = a^2 / (1 + a^2).
  const double stretch = std::sqrt(1.0 + steepest * steepest);
  return {.size_m = options.size_m,
          .position =
              [=](const Vec2& p) { return Vec3(p.x(), p.y(), amplitude * std::sin(rate * p.y())); },
          .normal = [=](const Vec2& p) -> Vec3 {
            return Vec3(0.0, -steepest * std::cos(rate * p.y()), 1.0).normalized();
          },
          .unrolled =
              [=](const Vec2& p) {
                return Vec2(p.x(),
                            stretch / rate * std::ellint_2(steepest / stretch, rate * p.y()));
              }};
}

Sheet folded_sheet(const FoldedOptions& options) {
  require_length("folded_sheet", "gap_m", options.gap_m);
  require_length("folded_sheet", "flank_m", options.flank_m);
  require_length("folded_sheet", "width_m", options.width_m);
  return {.size_m = Vec2(3.0 * options.flank_m + kPi * options.gap_m, options.width_m),
          .position =
              [=](const Vec2& p) {
                const Vec2 place = fold(options, p.x()).place;
                return Vec3(place.x(), p.y(), place.y());
              },
          .normal =
              [=](const Vec2& p) {
                const Vec2 normal = fold(options, p.x()).normal;
                return Vec3(normal.x(), 0.0, normal.y());
              },
          .unrolled = [](const Vec2& p) { return p; }};
}

}  // namespace palpation
