#include "world/shape_curves.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPoints = 240;

Vec2 on_circle(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Harmonics that fall off with their number, so that the outline's curvature stays that of tissue.
Curve star(Random& random) {
  constexpr int kFirst = 2, kLast = 5;
  std::array<double, kLast + 1> cosine{}, sine{};
  for (int k = kFirst; k <= kLast; ++k) {
    cosine[k] = 0.35 * random.normal() / k;
    sine[k] = 0.35 * random.normal() / k;
  }
  Curve curve;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * kPi * i / kPoints;
    double radius = 1.0;
    for (int k = kFirst; k <= kLast; ++k)
      radius += cosine[k] * std::cos(k * angle) + sine[k] * std::sin(k * angle);
    if (radius <= 0.1) return {};
    curve.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return curve;
}

/// A middle line of length 1 that turns by 60 to 220 degrees. Its half width's derivative vanishes
/// at both ends, where half circles close the outline.
Curve bent(Random& random) {
  const double turn = uniform(random, 60.0, 220.0) * kPi / 180.0;
  const double half_width = 0.5 / uniform(random, 1.5, 4.0);
  const double taper = uniform(random, -0.3, 0.3), waist = uniform(random, -0.25, 0.25);
  const auto width_at = [&](double s) {
    return half_width * (1.0 + taper * std::cos(kPi * s) + waist * std::cos(2.0 * kPi * s));
  };
  const auto middle = [&](double s) -> Vec2 {
    return Vec2(std::sin(turn * s), 1.0 - std::cos(turn * s)) / turn;
  };
  const auto normal = [&](double s) -> Vec2 {
    return Vec2(-std::sin(turn * s), std::cos(turn * s));
  };
  constexpr int kAlong = 80, kAround = 40;
  Curve curve;
  const auto add_cap = [&](double s, double start) {
    for (int i = 1; i < kAround; ++i) {
      const double angle = start + kPi * i / kAround;
      curve.push_back(middle(s) + width_at(s) * Vec2(std::cos(angle), std::sin(angle)));
    }
  };
  for (int i = 0; i <= kAlong; ++i)
    curve.push_back(middle(i / double{kAlong}) -
                    width_at(i / double{kAlong}) * normal(i / double{kAlong}));
  add_cap(1.0, turn - 0.5 * kPi);
  for (int i = kAlong; i >= 0; --i)
    curve.push_back(middle(i / double{kAlong}) +
                    width_at(i / double{kAlong}) * normal(i / double{kAlong}));
  add_cap(0.0, 0.5 * kPi);
  return curve;
}

Curve ellipse(Random& random) {
  const double slenderness = uniform(random, 1.3, 3.0);
  Curve curve;
  for (int i = 0; i < kPoints; ++i) {
    const Vec2 place = on_circle(2.0 * kPi * i / kPoints);
    curve.emplace_back(slenderness * place.x(), place.y());
  }
  return curve;
}

/// A rectangle of which a corner is cut out: one inner corner and five outer ones.
Curve ell(Random& random) {
  const double width = uniform(random, 1.0, 1.6);
  const double right = width * uniform(random, 0.35, 0.6), up = uniform(random, 0.35, 0.6);
  return {{0.0, 0.0}, {width, 0.0}, {width, up}, {right, up}, {right, 1.0}, {0.0, 1.0}};
}

/// A star of three to seven points, which may be sharp.
Curve points(Random& random) {
  const int count = 3 + static_cast<int>(random.below(5));
  const double inner = uniform(random, 0.45, 0.75);
  Curve curve;
  for (int i = 0; i < 2 * count; ++i)
    curve.push_back((i % 2 == 0 ? 1.0 : inner) * on_circle(kPi * i / count));
  return curve;
}

/// Two disks, of which one may be smaller, and a neck between them.
Curve dumbbell(Random& random) {
  const double other = uniform(random, 0.6, 1.0), neck = uniform(random, 0.3, 0.55) * other;
  const double apart = 1.0 + other + uniform(random, 0.2, 0.8);
  const double at_first = std::asin(neck), at_other = std::asin(neck / other);
  Curve curve;
  constexpr int kAround = 100;
  for (int i = 0; i <= kAround; ++i)
    curve.push_back(on_circle(at_first + (2.0 * kPi - 2.0 * at_first) * i / kAround));
  for (int i = 0; i <= kAround; ++i)
    curve.push_back(Vec2(apart, 0.0) +
                    other * on_circle(-kPi + at_other + 2.0 * (kPi - at_other) * i / kAround));
  return curve;
}

/// A disk of which another disk is cut out: two sharp horns.
Curve crescent(Random& random) {
  const double cut = uniform(random, 0.7, 1.1);
  const double away = uniform(random, 0.6, 0.9) * (cut < 1.0 ? 1.0 : cut);
  // The circles meet at `at` on the first one, seen from the other's centre at `inward`.
  const double x = (1.0 - cut * cut + away * away) / (2.0 * away);
  const double at = std::acos(x), inward = std::atan2(std::sin(at), x - away);
  Curve curve;
  constexpr int kAround = 120;
  for (int i = 0; i <= kAround; ++i)
    curve.push_back(on_circle(at + (2.0 * kPi - 2.0 * at) * i / kAround));
  for (int i = 1; i < kAround; ++i)
    curve.push_back(Vec2(away, 0.0) +
                    cut * on_circle(-inward - (2.0 * kPi - 2.0 * inward) * i / kAround));
  return curve;
}

}  // namespace

Curve draw_curve(ShapeFamily family, Random& random) {
  switch (family) {
    case ShapeFamily::Star:
      return star(random);
    case ShapeFamily::Bent:
      return bent(random);
    case ShapeFamily::Ellipse:
      return ellipse(random);
    case ShapeFamily::Ell:
      return ell(random);
    case ShapeFamily::Pointed:
      return points(random);
    case ShapeFamily::Dumbbell:
      return dumbbell(random);
    case ShapeFamily::Crescent:
      return crescent(random);
  }
  return {};
}

}  // namespace palpation
