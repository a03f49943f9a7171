#include "palpation/belief/height.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/positive_definite.h"
#include "belief/site_patches.h"
#include "palpation/base/error.h"
#include "palpation/geometry/thin.h"

namespace palpation {
namespace {

constexpr int kLeastSites = 12;
constexpr double kLeastLength = 1.5;  // in distances of contacts
constexpr int kNeighbours = 8;
constexpr double kSuspect = 8.0;  // robust deviations from the neighbours' median
constexpr double kOutlier = 5.0;  // standard deviations from what the others say
constexpr int kRounds = 3;        // of leaving outliers out
constexpr double kNormal95 = 1.959963984540054;
constexpr double kMedianToSd = 1.4826;
constexpr double kLeastCalibration = 0.5, kMostCalibration = 3.0;

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// A contact as the reference sees it.
struct Footed {
  SurfacePoint foot;
  double height = 0.0;
  double beside = 0.0;  // its offset across the normal
};

Footed footed(const Surface& reference, const Vec3& contact) {
  const SurfacePoint foot = reference.project(contact);
  const Vec3 offset = contact - reference.position(foot);
  const Vec3 normal = reference.normal(foot);
  const double height = offset.dot(normal);
  return {foot, height, (offset - height * normal).norm()};
}

/// The sites, and what is thought of them.
struct Sites {
  Points places;
  std::vector<Palpation> palpations;  // reading: the height
  std::vector<bool> left_out;
  std::vector<double> residual, sd;  // from what the others say; that of their difference
};

/// Sites that stand out of their neighbours before anything is fitted: one of them would be taken
/// for noise everywhere.
void suspect(Sites& sites) {
  std::vector<double> off;
  for (Eigen::Index i = 0; i < sites.places.rows(); ++i) {
    std::vector<double> around;
    for (const int j : nearest_to(sites.places, sites.places.row(i), kNeighbours + 1)) {
      if (j != i) around.push_back(sites.palpations[static_cast<std::size_t>(j)].reading);
    }
    off.push_back(std::abs(sites.palpations[static_cast<std::size_t>(i)].reading -
                           quantile(std::move(around), 0.5)));
  }
  const double usual = kMedianToSd * quantile(off, 0.5);
  for (std::size_t i = 0; i < off.size(); ++i) sites.left_out[i] = off[i] > kSuspect * usual;
}

std::vector<Palpation> used(const Sites& sites) {
  std::vector<Palpation> result;
  for (std::size_t i = 0; i < sites.palpations.size(); ++i) {
    if (!sites.left_out[i]) result.push_back(sites.palpations[i]);
  }
  return result;
}

double spread_of(const std::vector<Palpation>& palpations) {
  double square = 0.0;
  for (const Palpation& each : palpations) square += each.reading * each.reading;
  return std::sqrt(square / static_cast<double>(palpations.size()));
}

Prior prior_of(const Surface& reference, const Hyperparameters& values) {
  return {reference, Metric::Ambient,
          Kernel{.family = KernelFamily::Matern52,
                 .length_m = values.length_m,
                 .signal_sd = values.signal_sd},
          Constant{.sd = 0.0}};
}

/// Of greatest likelihood over the patches, from little and from much noise.
Hyperparameters learned_from(const Surface& reference, const Sites& sites,
                             const HeightOptions& options) {
  std::vector<Palpation> patches;
  for (const int i : patches_of(sites.places)) {
    if (!sites.left_out[static_cast<std::size_t>(i)])
      patches.push_back(sites.palpations[static_cast<std::size_t>(i)]);
  }
  const double length_m = 4.0 * options.spacing_m;
  const double spread = std::max(spread_of(patches), 1e-6 * options.spacing_m);
  LearnOptions how{.length_median_m = length_m, .likelihood_alone = true};
  if (options.noise_sd_m > 0.0) how.noise_sd = options.noise_sd_m;
  const auto from = [&](double noise) {
    const Hyperparameters start{.length_m = how.length_m.value_or(length_m),
                                .signal_sd = spread,
                                .noise_sd = how.noise_sd.value_or(noise * spread)};
    return learn(prior_of(reference, start), patches, start, how);
  };
  const auto best = [&] {
    const Learned little = from(0.02), much = from(0.5);
    return (much.log_posterior > little.log_posterior ? much : little).values;
  };
  const Hyperparameters found = best();
  const double least_m = kLeastLength * options.spacing_m;
  if (found.length_m >= least_m) return found;
  how.length_m = least_m;
  return best();
}

/// What all other sites say of each, by the inverse C of the covariance of those that count, noise
/// included: the residual of site i is (C y)_i / C_ii, of variance 1 / C_ii; of one that does not
/// count y - k' C y, of variance noise + k(0) - k' C k.
void leave_one_out(const Prior& prior, double noise_sd, Sites& sites) {
  std::vector<std::size_t> in, out;
  std::vector<SurfacePoint> places, others;
  for (std::size_t i = 0; i < sites.palpations.size(); ++i) {
    (sites.left_out[i] ? out : in).push_back(i);
    (sites.left_out[i] ? others : places).push_back(sites.palpations[i].where);
  }
  Field heights(static_cast<Eigen::Index>(in.size()));
  for (std::size_t i = 0; i < in.size(); ++i)
    heights[static_cast<Eigen::Index>(i)] = sites.palpations[in[i]].reading;

  Eigen::MatrixXd inverse = prior.covariance(places, places);
  inverse.diagonal().array() += noise_sd * noise_sd;
  if (!PositiveDefiniteInverse()(inverse))
    throw NumericalError("fit_height: the covariance of " + std::to_string(in.size()) +
                         " sites is not positive definite");
  const auto symmetric = inverse.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd weights = symmetric * heights;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    sites.residual[in[i]] = weights[k] / inverse(k, k);
    sites.sd[in[i]] = 1.0 / std::sqrt(inverse(k, k));
  }
  if (out.empty()) return;
  const Eigen::MatrixXd covariance = prior.covariance(places, others);
  const Eigen::MatrixXd solved = symmetric * covariance;
  const double prior_variance = std::pow(prior.kernel().signal_sd, 2);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double explained = covariance.col(k).dot(solved.col(k));
    sites.residual[out[i]] = sites.palpations[out[i]].reading - covariance.col(k).dot(weights);
    sites.sd[out[i]] = std::sqrt(noise_sd * noise_sd + std::max(prior_variance - explained, 0.0));
  }
}

double calibration_of(const Sites& sites) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < sites.sd.size(); ++i) {
    if (!sites.left_out[i]) scores.push_back(std::abs(sites.residual[i]) / sites.sd[i]);
  }
  return std::clamp(quantile(std::move(scores), 0.95) / kNormal95, kLeastCalibration,
                    kMostCalibration);
}

/// Leaves out what the others contradict, takes back what they do not, until that is settled.
/// Returns the options of the belief that says so.
struct Settled {
  Hyperparameters values;
  double calibration = 1.0;
};
Settled settle(const Surface& reference, Sites& sites, const HeightOptions& options) {
  suspect(sites);
  Settled result;
  for (int round = 0; round < kRounds; ++round) {
    if (round < 2) result.values = learned_from(reference, sites, options);
    leave_one_out(prior_of(reference, result.values), result.values.noise_sd, sites);
    result.calibration = calibration_of(sites);
    std::vector<bool> left_out(sites.left_out.size());
    for (std::size_t i = 0; i < left_out.size(); ++i)
      left_out[i] = std::abs(sites.residual[i]) > kOutlier * result.calibration * sites.sd[i];
    const bool settled = left_out == sites.left_out;
    if (round + 1 < kRounds) sites.left_out = left_out;
    if (settled && round > 0) break;
  }
  return result;
}

Sites sites_of(const Surface& reference, const Thinned& groups) {
  Sites sites{groups.points, {}, {}, {}, {}};
  for (Eigen::Index i = 0; i < groups.points.rows(); ++i) {
    const Footed place = footed(reference, groups.points.row(i));
    sites.palpations.push_back({.where = place.foot, .reading = place.height});
  }
  const std::size_t count = sites.palpations.size();
  sites.left_out.assign(count, false);
  sites.residual.assign(count, 0.0);
  sites.sd.assign(count, 0.0);
  return sites;
}

/// The scatter of single contacts about the surface beyond what is unsure of it: so that 95 % of
/// them lie within 1.96.
double scatter(const std::vector<double>& residuals, const std::vector<double>& variances) {
  const double whole = quantile(residuals, 0.95) / kNormal95;
  return std::sqrt(std::max(whole * whole - quantile(variances, 0.5), 0.0));
}

void check(const Points& contacts, const HeightOptions& options) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require(contacts.allFinite(), "fit_height", "contacts", "must be finite");
  require(positive(options.spacing_m), "fit_height", "spacing_m = " + text_of(options.spacing_m),
          "must be positive");
  require(positive(options.reach_m), "fit_height", "reach_m = " + text_of(options.reach_m),
          "must be positive");
  require(std::isfinite(options.noise_sd_m) && options.noise_sd_m >= 0.0, "fit_height",
          "noise_sd_m = " + text_of(options.noise_sd_m), "must not be negative");
  require(options.most_sites >= kLeastSites, "fit_height",
          "most_sites = " + std::to_string(options.most_sites), "must be at least 12");
}

/// Of the contacts that lie over the reference, each in its group of sites.
struct Over {
  std::vector<int> contacts;
  std::vector<Footed> feet;
  Thinned groups;
};

Over over(const Surface& reference, const Points& contacts, const HeightOptions& options,
          std::vector<int>& beyond) {
  Over result;
  for (Eigen::Index i = 0; i < contacts.rows(); ++i) {
    const Footed place = footed(reference, contacts.row(i));
    if (place.beside > options.reach_m) {
      beyond.push_back(static_cast<int>(i));
    } else {
      result.contacts.push_back(static_cast<int>(i));
      result.feet.push_back(place);
    }
  }
  result.groups = thin(contacts(result.contacts, Eigen::all), options.most_sites);
  if (result.groups.points.rows() < kLeastSites)
    throw NumericalError("fit_height: only " + std::to_string(result.groups.points.rows()) +
                         " contacts lie over the reference surface; at least 12 are needed");
  return result;
}

}  // namespace

HeightFit fit_height(const Surface& reference, const Points& contacts,
                     const HeightOptions& options) {
  check(contacts, options);
  HeightFit fit;
  const Over over_it = over(reference, contacts, options, fit.beyond);
  Sites sites = sites_of(reference, over_it.groups);
  const Settled settled = settle(reference, sites, options);
  fit.learned = settled.values;
  fit.calibration = settled.calibration;
  const std::vector<Palpation> counted = used(sites);
  fit.sites = static_cast<int>(counted.size());
  const Marginals at = marginals_once(prior_of(reference, settled.values),
                                      {.noise_sd = settled.values.noise_sd}, counted);
  fit.height_sd = settled.calibration * at.variance.cwiseMax(0.0).cwiseSqrt();

  std::vector<double> residuals, variances;
  const bool alone = over_it.groups.radius_m == 0.0;
  for (std::size_t i = 0; i < over_it.feet.size(); ++i) {
    const auto site = static_cast<std::size_t>(over_it.groups.group[i]);
    const Footed& place = over_it.feet[i];
    const double sd = reference.interpolate(fit.height_sd, place.foot);
    const double residual =
        alone ? sites.residual[site] : place.height - reference.interpolate(at.mean, place.foot);
    residuals.push_back(std::abs(residual));
    variances.push_back(
        alone ? std::max(std::pow(settled.calibration * sites.sd[site], 2) -
                             std::pow(settled.calibration * settled.values.noise_sd, 2),
                         0.0)
              : sd * sd);
  }
  fit.contact_sd = scatter(residuals, variances);
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const auto site = static_cast<std::size_t>(over_it.groups.group[i]);
    const bool off = residuals[i] > kOutlier * std::hypot(fit.contact_sd, std::sqrt(variances[i]));
    if (sites.left_out[site] || (!alone && off)) fit.outliers.push_back(over_it.contacts[i]);
  }
  fit.mesh = reference.mesh();
  fit.mesh.vertices += at.mean.asDiagonal() * reference.vertex_normals();
  return fit;
}

}  // namespace palpation
