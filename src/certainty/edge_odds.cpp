// Whether there is an edge at all, or healthy tissue that waves slowly, or both.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/log_mean.h"
#include "certainty/edge_belief_fit.h"
#include "certainty/edge_data.h"
#include "certainty/errors_in_turn.h"
#include "certainty/wave_evidence.h"
#include "palpation/certainty/misfit.h"

namespace palpation {
namespace {

/// Of waves: from the longer ones of the outlines' background on, to as long as tissue is wide.
constexpr std::array kLengths_m = {0.008, 0.012, 0.018, 0.027, 0.04};
/// Over so many readings errors may last, as a sensor's warmth, a cable or a hand make them.
constexpr std::array kInTurn = {3.0, 10.0, 30.0, 100.0};
/// How high they may be, of how the readings spread.
constexpr std::array kErrors = {0.03, 0.1, 0.3, 1.0};
/// Texture of real tissue beside an edge and slow waves, and how high it may be, of how the
/// readings spread.
constexpr double kTexture_m = 0.005;
/// Of what lies in the tissue and passes for errors in turn along a row.
constexpr std::array kTextureLengths_m = {0.005, 0.012};
constexpr std::array kTextures = {0.0, 0.03, 0.1, 0.3};

double spread_of(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// Without an edge: one plateau, of which nothing is known.
Rows without_edge(const Rows& rows, const Eigen::VectorXd& readings) {
  const Eigen::Index count = readings.size();
  const double spread = spread_of(readings);
  return {rows.data, readings.array() - readings.mean(),
          Eigen::MatrixXd::Constant(count, count, spread * spread)};
}

SlowWaves waves_of(const Prior& correction, double length_m, const EdgeData& data) {
  return {correction.surface(), correction.metric(), length_m, data.places};
}

WavesFound likeliest(std::vector<WavesFound> found) {
  return *std::ranges::max_element(found, {}, &WavesFound::log_density);
}

/// By what makes readings alike, in turn or in space, without waves: how probable the likeliest
/// errors make the readings.
struct ByErrors {
  double level = -std::numeric_limits<double>::infinity();
  LastingErrors errors{};
  Eigen::VectorXd pull{};  ///< WithWaves::pull

  /// `alike`: the correlations of errors that last over so many readings.
  void weigh(const Rows& rows, double spread, const Eigen::MatrixXd& alike, double readings) {
    for (const double height : kErrors) {
      Rows erring = rows;
      erring.covariance += std::pow(height * spread, 2) * alike;
      const WithWaves with(erring, spread);
      if (!(with.level() > level)) continue;
      level = with.level();
      errors = {readings, height * spread};
      pull = with.pull();
    }
  }
};

/// By texture and slow waves.
struct Explained {
  double log_evidence = -std::numeric_limits<double>::infinity();  ///< the mean over both
  double level = -std::numeric_limits<double>::infinity();         ///< by the likeliest texture
  WavesFound most{};
  std::size_t length = 0;  ///< of the likeliest waves

  Explained(const Rows& rows, double spread, const Eigen::MatrixXd& texture,
            const std::vector<SlowWaves>& waves) {
    LogMean all;
    for (const double height : kTextures) {
      Rows textured = rows;
      textured.covariance += std::pow(height * spread, 2) * texture * texture.transpose();
      const WithWaves with(textured, spread);
      level = std::max(level, with.level());
      for (std::size_t i = 0; i < waves.size(); ++i) {
        for (WavesFound& one : with.of(waves[i].terms())) {
          all.add(one.log_density);
          if (!(one.log_density > most.log_density)) continue;
          most = std::move(one);
          length = i;
        }
      }
    }
    log_evidence = all.value();
  }
};

}  // namespace

/// About the fit's edge and the readings as they were before waves or drift were taken from them.
struct EdgeBelief::AsFelt {
  Rows rows;
  Eigen::VectorXd readings;

  /// `taken_back`: of each row.
  AsFelt(const Fit& fit, const Eigen::VectorXd& taken_back)
      : readings(fit.data.reading + taken_back) {
    Eigen::MatrixXd covariance = fit.edge.covariance.reconstructedMatrix();
    rows = {fit.data, covariance * fit.edge.pull + taken_back, covariance};
    rows.covariance.diagonal() -= fit.edge.scatter * fit.data.variance;
  }
  AsFelt(const Surface& surface, const Fit& fit, const Field& taken_back)
      : AsFelt(fit, at_rows(surface, fit, taken_back)) {}

 private:
  static Eigen::VectorXd at_rows(const Surface& surface, const Fit& fit, const Field& field) {
    Eigen::VectorXd at = Eigen::VectorXd::Zero(fit.data.reading.size());
    if (field.size() == 0) return at;
    for (Eigen::Index i = 0; i < at.size(); ++i)
      at[i] = surface.interpolate(field, fit.data.places[static_cast<std::size_t>(i)]);
    return at;
  }
};

EdgeOdds EdgeBelief::odds_over_waves(const Field& taken_back) const {
  const Fit& fit = most_likely();
  const AsFelt here(surface_, fit, taken_back);
  const double spread = spread_of(here.readings);
  const Rows flat = without_edge(here.rows, here.readings);
  const WithWaves edge(here.rows, spread), none(flat, spread);
  EdgeOdds odds;
  double with_edge = edge.level(), without = none.level();
  for (const double length_m : kLengths_m) {
    const SlowWaves waves = waves_of(fit.correction, length_m, fit.data);
    with_edge = std::max(with_edge, likeliest(edge.of(waves.terms())).log_density);
    const double waves_alone = likeliest(none.of(waves.terms())).log_density;
    if (waves_alone > without) {
      without = waves_alone;
      odds.wave_length_m = length_m;
    }
  }
  odds.log_odds = with_edge - freedom_ - without;
  return odds;
}

EdgeInErrors EdgeBelief::in_lasting_errors(const Eigen::VectorXd& taken_back) const {
  const Fit& fit = most_likely();
  const AsFelt here(fit, mean_in_turn(taken_back, fit.data.made));
  const double spread = spread_of(here.readings);
  const Rows flat = without_edge(here.rows, here.readings);
  ByErrors alone, beside, textured;
  for (const double readings : kInTurn) {
    const Eigen::MatrixXd alike = errors_in_turn(fit.data.made, readings);
    alone.weigh(flat, spread, alike, readings);
    beside.weigh(here.rows, spread, alike, readings);
  }
  for (const double length_m : kTextureLengths_m) {
    const Eigen::MatrixXd texture = waves_of(fit.correction, length_m, fit.data).terms();
    textured.weigh(here.rows, spread, texture * texture.transpose(), 0.0);
  }
  const double by_noise = WithWaves(here.rows, spread).level();
  EdgeInErrors found{
      .log_evidence = std::max(by_noise, beside.level) - freedom_,
      .log_evidence_in_texture = std::max(by_noise, textured.level) - freedom_,
      .log_evidence_without_edge = alone.level,
      .errors_without_edge = alone.errors,
      .do_last_without_edge = alone.level > WithWaves(flat, spread).level() + surprising(),
      .drift = Eigen::VectorXd::Zero(taken_back.size())};
  if (!(beside.level > by_noise + surprising())) return found;
  found.errors = beside.errors;
  found.drift = beside.errors.sd * beside.errors.sd *
                errors_at_each(taken_back.size(), fit.data.made, beside.errors.readings) *
                beside.pull;
  return found;
}

EdgeInWaves EdgeBelief::in_slow_waves(const Field& taken_back) const {
  const Fit& fit = most_likely();
  const AsFelt here(surface_, fit, taken_back);
  const double spread = spread_of(here.readings);
  const Eigen::MatrixXd texture = waves_of(fit.correction, kTexture_m, fit.data).terms();
  std::vector<SlowWaves> waves;
  for (const double length_m : kSlowLengths_m)
    waves.push_back(waves_of(fit.correction, length_m, fit.data));
  const Explained edge(here.rows, spread, texture, waves),
      none(without_edge(here.rows, here.readings), spread, texture, waves);
  EdgeInWaves found{.log_evidence = edge.log_evidence - freedom_,
                    .log_evidence_level = edge.level - freedom_,
                    .log_evidence_without_edge = std::max(none.log_evidence, none.level)};
  if (edge.most.coefficients.size() == 0) {  // no noise makes the covariance positive definite
    found.waves = Field::Zero(surface_.vertex_count());
    return found;
  }
  found.scale = {kSlowLengths_m[edge.length], edge.most.height};
  found.waves = waves[edge.length].at_vertices(edge.most.height * edge.most.coefficients);
  return found;
}

}  // namespace palpation
