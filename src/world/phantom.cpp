#include "palpation/world/phantom.h"

#include <cmath>
#include <string>

#include "palpation/base/error.h"

namespace palpation {
namespace {

void check(const StiffnessModel& model) {
  const auto need = [](bool condition, const std::string& name, double value,
                       const std::string& rule) {
    require(condition, "Phantom", name + " " + text_of(value), rule);
  };
  need(std::isfinite(model.low), "low", model.low, "must be finite");
  need(std::isfinite(model.high) && model.high > model.low && std::isfinite(model.high - model.low),
       "high", model.high, "must be finite and above low");
  need(std::isfinite(model.slope_per_m) && model.slope_per_m > 0.0, "slope", model.slope_per_m,
       "must be positive and finite");
  need(std::isfinite(model.noise) && model.noise >= 0.0, "noise", model.noise,
       "must be finite and not negative");
  need(std::isfinite(model.bias), "bias", model.bias, "must be finite");
  need(model.fraction > 0.0 && model.fraction < 1.0, "fraction", model.fraction,
       "must be above 0 and below 1");
  need(std::isfinite(model.lag_m), "lag", model.lag_m, "must be finite");
  require(model.bias_axis.allFinite(), "Phantom", "bias axis", "must be finite");
}

Vec3 longest_side(const Points& vertices) {
  Eigen::Index longest = 0;
  (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff(&longest);
  return Vec3::Unit(longest);
}

/// x1 of equation (4): from 0 to 1 over the tissue along an axis.
Field fraction_along(const Points& vertices, const Vec3& axis) {
  const Field along = vertices * axis.normalized();
  const double extent = along.maxCoeff() - along.minCoeff();
  require(extent > 1e-9 * along.cwiseAbs().maxCoeff(), "Phantom", "bias axis",
          "must not be at a right angle to the whole tissue");
  return (along.array() - along.minCoeff()) / extent;
}

}  // namespace

Phantom::Phantom(Surface surface, std::vector<Tumour> tumours, const StiffnessModel& model)
    : surface_(std::move(surface)), model_(model) {
  check(model_);
  const Points& vertices = surface_.mesh().vertices;
  bias_ = fraction_along(vertices,
                         model_.bias_axis.isZero(0.0) ? longest_side(vertices) : model_.bias_axis);
  distance_ = signed_distance(surface_, tumours);
  truth_ = distance_.unaryExpr([this](double distance_m) { return stiffness(distance_m); });
}

double Phantom::true_level() const {
  return model_.low + model_.fraction * (model_.high - model_.low);
}

// Equation (4): Y(x) = low + (high - low) / (1 + exp(-slope d(x) - ln(f / (1 - f)))) + bias x1
// (high - low) + noise
double Phantom::stiffness(double signed_distance_m) const {
  const double shift = std::log(model_.fraction / (1.0 - model_.fraction));
  return model_.low + (model_.high - model_.low) /
                          (1.0 + std::exp(-model_.slope_per_m * signed_distance_m - shift));
}

Palpation Phantom::touch(const SurfacePoint& where, Random& random) const {
  const double range = model_.high - model_.low;
  const double bias = model_.bias * surface_.interpolate(bias_, where) * range;
  // Drawn even where there is no noise: the same stream then serves every noise level.
  const double noise = random.normal() * model_.noise * range;
  Palpation palpation;
  palpation.where = where;
  palpation.reading = stiffness(surface_.interpolate(distance_, where)) + bias + noise;
  return palpation;
}

Palpation Phantom::touch(const SurfacePoint& where, const Vec3& travel, Random& random) const {
  if (model_.lag_m == 0.0 || travel.isZero(0.0)) return touch(where, random);
  Palpation palpation =
      touch(surface_.project(surface_.position(where) - model_.lag_m * travel), random);
  palpation.where = where;
  return palpation;
}

}  // namespace palpation
