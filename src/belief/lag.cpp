#include "palpation/belief/lag.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "belief/likelihood.h"
#include "belief/sites.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kBeside_m = 0.0005;  // a displaced reading may lie this far beyond the border: as
                                      // far as a touch is smaller than a probe
constexpr double kGridStep_m =
    0.00025;  // a field's likelihood has one peak within a fraction of its length
constexpr double kPrecision_m = 1e-5;
constexpr double kOneLine = 0.95;  // cosine: within 18 degrees
constexpr int kBlocks = 10;
constexpr double kEdgeStep_m = 0.001;
constexpr double kEdgeShare = 0.5;
constexpr double kEdgeNoise = 0.1;  // of the signal: so that drift is no edge
constexpr std::size_t kLeastAtEdges = 20;
constexpr std::size_t kMostReadings =
    400;  // for one number; the likelihood costs their third power

bool is_on_border(const Surface& surface, const SurfacePoint& point) {
  for (int i = 0; i < 3; ++i) {
    if (point.barycentric[(i + 2) % 3] < 1e-9 && surface.neighbour(point.face, i) < 0) return true;
  }
  return false;
}

/// Where a reading belongs; nothing if that is beyond the border.
std::optional<SurfacePoint> place_of(const Surface& surface, const Palpation& palpation,
                                     double lag_m) {
  const Vec3 position = surface.position(palpation.where) - lag_m * palpation.travel;
  const SurfacePoint closest = surface.project(position);
  if (!is_on_border(surface, closest)) return closest;
  const Vec3 normal = surface.face_normal(closest.face);
  const Vec3 offset = position - surface.position(closest);
  if ((offset - normal.dot(offset) * normal).norm() > kBeside_m) return std::nullopt;
  return closest;
}

bool travels(const Palpation& palpation) { return !palpation.travel.isZero(0.0); }

/// The readings that every lag leaves on the tissue, thinned evenly.
std::vector<Palpation> telling(const Surface& surface, std::span<const Palpation> palpations,
                               const LagPrior& prior) {
  std::vector<Palpation> kept;
  for (const Palpation& palpation : palpations) {
    if (!palpation.set_aside.empty()) continue;
    if (travels(palpation) && !(place_of(surface, palpation, prior.least_m) &&
                                place_of(surface, palpation, prior.most_m)))
      continue;
    kept.push_back(palpation);
  }
  const std::size_t stride = (kept.size() + kMostReadings - 1) / kMostReadings;
  if (stride <= 1) return kept;
  std::vector<Palpation> thinned;
  for (std::size_t i = 0; i < kept.size(); i += stride) thinned.push_back(kept[i]);
  return thinned;
}

/// Whether all readings were made to and fro along one line, as a raster's are.
bool run_along_a_line(const std::vector<Palpation>& readings) {
  const auto first = std::find_if(readings.begin(), readings.end(), travels);
  return std::all_of(readings.begin(), readings.end(), [&](const Palpation& one) {
    return !travels(one) || std::abs(one.travel.dot(first->travel)) > kOneLine;
  });
}

/// Of the readings those at the edges, where the field, believed without a lag, changes along the
/// travel by half of the most it does anywhere; all where these are few.
std::vector<Palpation> at_edges(const Prior& prior, const std::vector<Palpation>& readings,
                                const Hyperparameters& at) {
  const Surface& surface = prior.surface();
  Kernel kernel = prior.kernel();
  kernel.length_m = at.length_m;
  kernel.signal_sd = at.signal_sd;
  const Prior field = prior.with(kernel);
  std::vector<SurfacePoint> places, ahead, behind;
  Eigen::VectorXd values(static_cast<Eigen::Index>(readings.size()));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Vec3 here = surface.position(readings[i].where), step = kEdgeStep_m * readings[i].travel;
    places.push_back(readings[i].where);
    ahead.push_back(surface.project(here + step));
    behind.push_back(surface.project(here - step));
    values[i] = readings[i].reading;
  }
  Eigen::MatrixXd covariance = field.covariance(places, places);
  const double least_noise = kEdgeNoise * at.signal_sd;
  covariance.diagonal().array() += std::max(at.noise_sd * at.noise_sd, least_noise * least_noise);
  const Eigen::VectorXd weights =
      covariance.llt().solve(Eigen::VectorXd(values.array() - values.mean()));
  const Eigen::VectorXd change =
      ((field.covariance(ahead, places) - field.covariance(behind, places)) * weights).cwiseAbs();
  std::vector<Palpation> kept;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (change[i] >= kEdgeShare * change.maxCoeff()) kept.push_back(readings[i]);
  }
  return kept.size() < kLeastAtEdges ? readings : kept;
}

/// The greatest value of a function with one peak between two places (golden section).
template <typename Function>
double peak_between(double least, double most, const Function& function) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = most - ratio * (most - least), right = least + ratio * (most - least);
  double at_left = function(left), at_right = function(right);
  while (most - least > kPrecision_m) {
    if (at_left >= at_right) {
      most = right;
      right = left;
      at_right = at_left;
      at_left = function(left = most - ratio * (most - least));
    } else {
      least = left;
      left = right;
      at_left = at_right;
      at_right = function(right = least + ratio * (most - least));
    }
  }
  return 0.5 * (least + most);
}

/// A lag's log posterior, but for a constant.
class LagPosterior {
 public:
  LagPosterior(const Prior& field, const Hyperparameters& at, const LagPrior& prior)
      : field_(field), at_(at), prior_(prior) {}

  double operator()(const std::vector<Palpation>& readings, double lag_m) const {
    const double z = (lag_m - prior_.mean_m) / prior_.sd_m;
    const std::vector<Palpation> moved = displaced(field_.surface(), readings, lag_m);
    try {
      return log_likelihood(field_, gather_sites(field_, moved), at_) - 0.5 * z * z;
    } catch (const NumericalError&) {
      return -std::numeric_limits<double>::infinity();  // this lag brings places together that the
                                                        // noise does not part
    }
  }

 private:
  const Prior& field_;
  const Hyperparameters& at_;
  const LagPrior& prior_;
};

/// The parabola through the posterior around a lag: where its peak is, from there, and its standard
/// deviation. Nothing where it has none.
struct Peak {
  double off_m, stddev_m;
};
std::optional<Peak> peak_around(const LagPosterior& posterior,
                                const std::vector<Palpation>& readings, double lag_m) {
  const double step = 0.5 * kGridStep_m;
  const double before = posterior(readings, lag_m - step), here = posterior(readings, lag_m),
               after = posterior(readings, lag_m + step), fall = 2.0 * here - before - after;
  if (!(fall > 0.0) || !std::isfinite(fall)) return std::nullopt;
  return Peak{0.5 * step * (after - before) / fall, step / std::sqrt(fall)};
}

/// What the lag scatters by, as the readings themselves tell: it is found again without each tenth
/// of them in turn (the jackknife for a stationary series, Kuensch 1989, here of blocks that do not
/// overlap; so few give the variance of Student's t). An edge is no stationary field, and the
/// curvature does not know that.
std::optional<double> scatter_m(const LagPosterior& posterior,
                                const std::vector<Palpation>& readings, double lag_m) {
  const auto count = static_cast<std::ptrdiff_t>(readings.size());
  double sum = 0.0, squares = 0.0;
  for (std::ptrdiff_t block = 0; block < kBlocks; ++block) {
    std::vector<Palpation> rest(readings.begin(), readings.begin() + block * count / kBlocks);
    rest.insert(rest.end(), readings.begin() + (block + 1) * count / kBlocks, readings.end());
    const std::optional<Peak> peak = peak_around(posterior, rest, lag_m);
    if (!peak) return std::nullopt;
    sum += peak->off_m;
    squares += peak->off_m * peak->off_m;
  }
  constexpr double kFreedom = kBlocks - 1.0;
  const double variance = kFreedom / kBlocks * (squares - sum * sum / kBlocks);
  return std::sqrt(std::max(variance, 0.0) * kFreedom / (kFreedom - 2.0));
}

}  // namespace

std::vector<Palpation> displaced(const Surface& surface, std::span<const Palpation> palpations,
                                 double lag_m) {
  require(std::isfinite(lag_m), "displaced", "lag_m = " + text_of(lag_m), "must be finite");
  std::vector<Palpation> moved(palpations.begin(), palpations.end());
  if (lag_m == 0.0) return moved;
  for (Palpation& palpation : moved) {
    if (!travels(palpation)) continue;
    if (const std::optional<SurfacePoint> place = place_of(surface, palpation, lag_m)) {
      palpation.where = *place;
    } else if (palpation.set_aside.empty()) {
      palpation.set_aside = "belongs beyond the tissue";
    }
  }
  return moved;
}

std::optional<Lag> learn_lag(const Prior& prior, std::span<const Palpation> palpations,
                             const Hyperparameters& at, const LagPrior& lag_prior) {
  const Surface& surface = prior.surface();
  std::vector<Palpation> readings = telling(surface, palpations, lag_prior);
  if (readings.size() < 2 || std::none_of(readings.begin(), readings.end(), travels))
    return std::nullopt;
  // A base that drifts along a raster's rows looks like a lag, but for the edges; touches from
  // everywhere average it out.
  if (run_along_a_line(readings)) readings = at_edges(prior, readings, at);
  const LagPosterior posterior(prior, at, lag_prior);
  double best = lag_prior.mean_m, best_value = -std::numeric_limits<double>::infinity();
  const int steps =
      static_cast<int>(std::lround((lag_prior.most_m - lag_prior.least_m) / kGridStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double lag_m = lag_prior.least_m + i * kGridStep_m;
    const double value = posterior(readings, lag_m);
    if (value > best_value) {
      best = lag_m;
      best_value = value;
    }
  }
  const double least = std::max(lag_prior.least_m, best - kGridStep_m),
               most = std::min(lag_prior.most_m, best + kGridStep_m);
  Lag lag{.value_m =
              peak_between(least, most, [&](double lag_m) { return posterior(readings, lag_m); }),
          .stddev_m = lag_prior.sd_m};
  lag.at_bound = std::min(lag.value_m - lag_prior.least_m, lag_prior.most_m - lag.value_m) <
                 2.0 * kPrecision_m;
  lag.log_gain = posterior(readings, lag.value_m) - posterior(readings, 0.0);
  const std::optional<Peak> peak = peak_around(posterior, readings, lag.value_m);
  const std::optional<double> scatter = scatter_m(posterior, readings, lag.value_m);
  if (peak && scatter) lag.stddev_m = std::min(lag.stddev_m, std::max(peak->stddev_m, *scatter));
  return lag;
}

}  // namespace palpation
