#include "palpation/world/random_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/cross.h"
#include "palpation/base/error.h"
#include "world/shape_curves.h"

namespace palpation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostDraws = 1000;
constexpr double kMostOfTissue = 0.25;

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
  require(std::isfinite(options.least_reach_m) && options.least_reach_m >= 0.0, "random_shape",
          "reach " + text_of(options.least_reach_m) + " m", "must be finite and not negative");
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
    const Curve unit = draw_curve(family, random);
    if (unit.empty() || signed_area(unit) <= 0.0) continue;
    const Curve shape = turned_and_scaled(unit, uniform(random, 0.0, 2.0 * kPi),
                                          std::sqrt(area / signed_area(unit)));
    const Bounds bounds = bounds_of(shape);
    const Vec2 spare =
        options.size_m.array() - 2.0 * options.margin_m - (bounds.most - bounds.least).array();
    if (spare.minCoeff() < 0.0 ||
        (options.least_reach_m > 0.0 && reach(shape) < options.least_reach_m))
      continue;
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
