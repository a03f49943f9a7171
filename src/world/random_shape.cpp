#include "palpation/world/random_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/cross.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostDraws = 1000;
constexpr int kPoints = 240;
constexpr double kMostOfTissue = 0.25;

using Curve = std::vector<Vec2>;

double uniform(Random& random, double least, double most) {
  return least + (most - least) * random.uniform();
}

double signed_area(const Curve& curve) {
  double twice = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i)
    twice += cross(curve[i], curve[(i + 1) % curve.size()]);
  return 0.5 * twice;
}

double perimeter(const Curve& curve) {
  double length = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i)
    length += (curve[(i + 1) % curve.size()] - curve[i]).norm();
  return length;
}

double reach(const Curve& curve) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = curve.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 tangent = (curve[(i + 1) % count] - curve[(i + count - 1) % count]).normalized();
    for (const Vec2& other : curve) {
      const Vec2 arm = other - curve[i];
      const double height = std::abs(cross(tangent, arm));
      if (height > 0.0) least = std::min(least, arm.squaredNorm() / (2.0 * height));
    }
  }
  return least;
}

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

struct Bounds {
  Vec2 least, most;
};

Bounds bounds_of(const Curve& curve) {
  Bounds bounds{curve.front(), curve.front()};
  for (const Vec2& point : curve) {
    bounds.least = bounds.least.cwiseMin(point);
    bounds.most = bounds.most.cwiseMax(point);
  }
  return bounds;
}

Curve turned_and_scaled(const Curve& curve, double angle, double factor) {
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  Curve result;
  for (const Vec2& point : curve) result.emplace_back(factor * (turn * point));
  return result;
}

Curve curve_of(const Outline& outline) {
  Curve curve;
  for (const Vec3& point : outline.points_m) curve.emplace_back(point.head<2>());
  return curve;
}

void check(const RandomShapeOptions& options) {
  const Vec2 room = options.size_m.array() - 2.0 * options.margin_m;
  require(options.margin_m >= 0.0 && room.allFinite() && room.minCoeff() > 0.0, "random_shape",
          "margin " + text_of(options.margin_m) + " m",
          "must not be negative, and leave some of the search area");
  require(std::isfinite(options.least_reach_m) && options.least_reach_m > 0.0, "random_shape",
          "reach " + text_of(options.least_reach_m) + " m", "must be positive and finite");
  require(options.least_area_m2 > 0.0 && options.least_area_m2 <= options.most_area_m2 &&
              options.most_area_m2 <= kMostOfTissue * room.prod(),
          "random_shape",
          "areas from " + text_of(options.least_area_m2) + " to " + text_of(options.most_area_m2) +
              " m2",
          "must be positive, rising and at most a quarter of the search area within its margins");
}

}  // namespace

Outline random_shape(ShapeFamily family, Random& random, const RandomShapeOptions& options) {
  check(options);
  const double area = uniform(random, options.least_area_m2, options.most_area_m2);
  // What is drawn anew is the shape, never the area: small ones would be rarer.
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const Curve unit = family == ShapeFamily::Star ? star(random) : bent(random);
    if (unit.empty() || signed_area(unit) <= 0.0) continue;
    const Curve shape = turned_and_scaled(unit, uniform(random, 0.0, 2.0 * kPi),
                                          std::sqrt(area / signed_area(unit)));
    const Bounds bounds = bounds_of(shape);
    const Vec2 spare =
        options.size_m.array() - 2.0 * options.margin_m - (bounds.most - bounds.least).array();
    if (spare.minCoeff() < 0.0 || reach(shape) < options.least_reach_m) continue;
    const double right = random.uniform() * spare.x(), up = random.uniform() * spare.y();
    const Vec2 shift = Vec2(right, up).array() + options.margin_m - bounds.least.array();
    Outline outline;
    for (const Vec2& point : shape)
      outline.points_m.emplace_back(point.x() + shift.x(), point.y() + shift.y(), 0.0);
    return outline;
  }
  throw InvalidInput("random_shape: reach " + text_of(options.least_reach_m) + " m: no shape of " +
                     text_of(area) + " m2 has it within the search area: must be smaller");
}

double signed_area(const Outline& outline) { return signed_area(curve_of(outline)); }
double perimeter(const Outline& outline) { return perimeter(curve_of(outline)); }
double reach(const Outline& outline) { return reach(curve_of(outline)); }

}  // namespace palpation
