#include "palpation/world/phantom.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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

/// Equation (4) as it stands.
bool is_plain(const Lump& lump) {
  return lump.profile == Profile::Sigmoid && lump.contrast == 1.0 && lump.steeper == 1.0;
}

void check(const Lump& lump) {
  const auto need = [](double value, const std::string& what) {
    require(std::isfinite(value) && value > 0.0, "Phantom", what + " " + text_of(value),
            "must be positive and finite");
  };
  need(lump.contrast, "a lump's contrast");
  need(lump.steeper, "a lump's steepness");
  require(lump.steep_towards.allFinite(), "Phantom", "a lump's steep side", "must be finite");
}

std::vector<Lump> as_lumps(std::vector<Tumour> tumours) {
  std::vector<Lump> lumps;
  for (Tumour& tumour : tumours) lumps.emplace_back().outline = std::move(tumour);
  return lumps;
}

}  // namespace

Phantom::Phantom(Surface surface, std::vector<Tumour> tumours, const StiffnessModel& model)
    : Phantom(std::move(surface), {.lumps = as_lumps(std::move(tumours)), .model = model}) {}

Phantom::Phantom(Surface surface, const PhantomDesign& design)
    : surface_(std::move(surface)), model_(design.model) {
  check(model_);
  for (const Lump& lump : design.lumps) check(lump);
  const Points& vertices = surface_.mesh().vertices;
  bias_ = fraction_along(vertices,
                         model_.bias_axis.isZero(0.0) ? longest_side(vertices) : model_.bias_axis);
  std::vector<Lump> plain;
  for (const Lump& lump : design.lumps) {
    if (is_plain(lump)) plain.push_back(lump);
  }
  if (!plain.empty() || design.lumps.empty()) add_layer(plain);
  for (const Lump& lump : design.lumps) {
    if (!is_plain(lump)) add_layer({lump});
  }
  if (!design.background.empty()) background_ = background_field(surface_, design.background);
  truth_ = Field::Constant(surface_.vertex_count(), model_.low);
  for (const Layer& layer : layers_) {
    for (int vertex = 0; vertex < surface_.vertex_count(); ++vertex)
      truth_[vertex] = std::max(
          truth_[vertex], stiffness(layer, layer.depth[vertex], surface_.vertex(vertex), 1.0));
  }
}

void Phantom::add_layer(std::vector<Lump> lumps) {
  std::vector<Tumour> outlines;
  for (const Lump& lump : lumps) outlines.push_back(lump.outline);
  Layer layer{.depth = signed_distance(surface_, outlines),
              .like = lumps.empty() ? Lump{} : lumps.front(),
              .greatest_depth_m = 0.0,
              .deepest = Vec3::Zero()};
  Eigen::Index deepest = 0;
  layer.greatest_depth_m = layer.depth.maxCoeff(&deepest);
  layer.deepest = surface_.vertex(static_cast<int>(deepest));
  layers_.push_back(std::move(layer));
}

double Phantom::true_level() const {
  return model_.low + model_.fraction * (model_.high - model_.low);
}

// Equation (4): Y(x) = low + (high - low) / (1 + exp(-slope d(x) - ln(f / (1 - f)))) + bias x1
// (high - low) + noise
double Phantom::stiffness(const Layer& layer, double depth_m, const Vec3& place,
                          double contrast) const {
  const double range = model_.high - model_.low;
  const double shift = std::log(model_.fraction / (1.0 - model_.fraction));
  if (is_plain(layer.like))
    return model_.low + range / (1.0 + std::exp(-model_.slope_per_m * depth_m - shift));
  if (!(layer.greatest_depth_m > 0.0)) return model_.low;  // no vertex lies in it
  const double side = std::clamp(
      (place - layer.deepest).dot(layer.like.steep_towards) / layer.greatest_depth_m, -1.0, 1.0);
  const double slope_per_m = model_.slope_per_m * std::pow(layer.like.steeper, side);
  return model_.low +
         range * contrast *
             profile_share(layer.like.profile, depth_m, layer.greatest_depth_m, slope_per_m, shift);
}

Palpation Phantom::touch(const SurfacePoint& where, Random& random) const {
  const double range = model_.high - model_.low;
  const double bias = model_.bias * surface_.interpolate(bias_, where) * range;
  // Drawn even where there is no noise: the same stream then serves every noise level.
  const double noise = random.normal() * model_.noise * range;
  double felt = model_.low;
  for (const Layer& layer : layers_)
    felt = std::max(felt, stiffness(layer, surface_.interpolate(layer.depth, where),
                                    surface_.position(where), layer.like.contrast));
  Palpation palpation;
  palpation.where = where;
  palpation.reading = felt + bias + noise;
  if (background_.size() > 0) palpation.reading += surface_.interpolate(background_, where) * range;
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
