/// The posterior by dense matrices, as its equations are written: the slow, obviously right twin of
/// every fast way to it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "palpation/belief/belief.h"

namespace palpation {

struct Dense {
  Eigen::VectorXd mean, variance;
  double log_likelihood;
};

/// Equations (1) and (2) of Garg et al. 2016, with a constant of the given prior.
inline Dense dense_posterior(const Prior& prior, std::span<const Palpation> palpations,
                             double noise_variance) {
  const auto n = static_cast<Eigen::Index>(palpations.size());
  std::vector<SurfacePoint> sites, vertices;
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    sites.push_back(palpations[i].where);
    y[i] = palpations[i].reading;
  }
  for (int vertex = 0; vertex < prior.surface().vertex_count(); ++vertex)
    vertices.push_back(prior.surface().at_vertex(vertex));
  Eigen::MatrixXd s = prior.covariance(sites, sites);
  for (Eigen::Index i = 0; i < n; ++i)
    s(i, i) +=
        std::isnan(palpations[i].noise_variance) ? noise_variance : palpations[i].noise_variance;
  const Eigen::MatrixXd cross = prior.covariance(sites, vertices);
  const Eigen::LLT<Eigen::MatrixXd> factor(s);
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  const double sd = prior.constant().sd;
  const double precision = sd > 0.0 ? ones.dot(inverse * ones) + 1.0 / (sd * sd)
                                    : std::numeric_limits<double>::infinity();
  const double constant = sd > 0.0 ? ones.dot(inverse * y) / precision : 0.0;
  Dense result;
  result.mean = (cross.transpose() * inverse * (y - constant * ones)).array() + constant;
  const Eigen::RowVectorXd residual =
      Eigen::RowVectorXd::Ones(cross.cols()) - ones.transpose() * inverse * cross;
  result.variance = prior.kernel().signal_sd * prior.kernel().signal_sd -
                    factor.matrixL().solve(cross).colwise().squaredNorm().transpose().array() +
                    residual.transpose().array().square() / precision;
  const Eigen::VectorXd r = y - constant * ones;
  const double square =
      r.dot(inverse * r) + (sd > 0.0 && std::isfinite(sd) ? constant * constant / (sd * sd) : 0.0);
  double log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
  double free = static_cast<double>(n);
  if (std::isinf(sd)) {
    log_determinant += std::log(precision);
    free -= 1.0;
  } else if (sd > 0.0) {
    log_determinant += std::log(precision * sd * sd);
  }
  result.log_likelihood =
      -0.5 * (square + log_determinant + free * std::log(2.0 * std::numbers::pi));
  return result;
}

inline double worst(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

template <typename A, typename B>
void expect_alike(const A& a, const B& b, double tolerance) {
  EXPECT_LE(worst(a.mean, b.mean), tolerance);
  EXPECT_LE(worst(a.variance, b.variance), tolerance);
}

}  // namespace palpation
