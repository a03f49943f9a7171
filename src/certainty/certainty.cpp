#include "palpation/certainty/certainty.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "certainty/band_width.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

void check_probability(double probability) {
  require(probability > 0.0 && probability < 1.0, "certainty_of",
          "probability = " + text_of(probability), "must lie in (0, 1)");
}

}  // namespace

Field Certainty::probability_inside() const {
  return score.unaryExpr([](double z) { return normal_probability(z); });
}

double Certainty::cut_score(double risk) {
  require(risk > 0.0 && risk < 1.0, "cut_score", "risk = " + text_of(risk), "must lie in (0, 1)");
  return normal_quantile(risk);
}

Certainty certainty_of(const Surface& surface, const Marginals& marginals, const Level& level,
                       double probability) {
  check_probability(probability);
  const double level_variance = level.stddev.value_or(0.0) * level.stddev.value_or(0.0);
  const double least_sd = 1e-9 * std::max(1e-300, marginals.mean.cwiseAbs().maxCoeff());
  Certainty certainty{
      .score = marginals.mean.array() - level.value, .probability = probability, .expected = {}};
  certainty.score.array() /= (marginals.variance.array() + level_variance).sqrt().max(least_sd);
  certainty.band_score = normal_quantile(0.5 + 0.5 * probability);
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  certainty.expected = expected_error(surface, marginals, level);
  return certainty;
}

Certainty certainty_of(const Surface& surface, const EdgeBelief& edge, double probability) {
  check_probability(probability);
  Certainty certainty{.score = edge.depth().array() / edge.offset_sd().array().max(1e-12),
                      .probability = probability,
                      .expected = {}};
  certainty.band_score = edge.band_score(probability);
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  certainty.expected.missed_m2 = certainty.expected.extra_m2 = 0.5 * edge.expected_error_m2();
  return certainty;
}

Certainty certainty_of(const Surface& surface, const OutlinePosterior& outlines,
                       double probability) {
  check_probability(probability);
  Certainty certainty{.score = outlines.depth.cwiseQuotient(outlines.spread),
                      .probability = probability,
                      .expected = outlines.expected};
  certainty.band_score = outlines.band_score(probability);
  certainty.half_width_m = mean_half_width(surface, certainty.score, certainty.band_score);
  return certainty;
}

}  // namespace palpation
