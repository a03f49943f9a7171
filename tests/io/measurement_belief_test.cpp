// From a file of measurements to what is believed: repeats, near repeats, order, offsets, and no
// reading at all.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "io/temporary_folder.h"
#include "palpation/base/random.h"
#include "palpation/belief/belief.h"
#include "palpation/geometry/make_plane.h"
#include "palpation/io/measurements.h"

namespace palpation {
namespace {

constexpr double kNoise = 0.3;

Surface tissue() {
  Random unused(0);
  return Surface(make_plane({.size_m = Vec2(0.02, 0.02), .columns = 9, .rows = 9}, unused));
}

Prior prior_on(const Surface& surface) {
  return Prior(surface, Metric::Chart, {.length_m = 0.004, .signal_sd = 2.0});
}

std::vector<Palpation> read(const Surface& surface, const std::string& text) {
  const TemporaryFolder folder;
  return read_measurements(folder.file("m.csv", text), surface).palpations;
}

Belief believe(const Surface& surface, const std::vector<Palpation>& palpations) {
  return Belief(prior_on(surface), {.noise_sd = kNoise}).condition_on(palpations);
}

/// One row for every reading, repeats or not, and a constant that is not known: universal kriging
/// as the textbook has it.
Marginals whole_model(const Surface& surface, const std::vector<Palpation>& palpations) {
  const Prior prior = prior_on(surface);
  const auto n = static_cast<Eigen::Index>(palpations.size());
  std::vector<SurfacePoint> sites, vertices;
  Eigen::VectorXd readings(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    sites.push_back(palpations[static_cast<std::size_t>(i)].where);
    readings[i] = palpations[static_cast<std::size_t>(i)].reading;
  }
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
    vertices.push_back(surface.at_vertex(vertex));
  Eigen::MatrixXd k = prior.covariance(sites, sites);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double own = palpations[static_cast<std::size_t>(i)].noise_variance;
    k(i, i) += std::isnan(own) ? kNoise * kNoise : own;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  const Eigen::VectorXd weights = factor.solve(ones);
  const double precision = weights.sum(), constant = weights.dot(readings) / precision;
  const Eigen::MatrixXd to_vertices = prior.covariance(sites, vertices);
  const Eigen::MatrixXd solved = factor.solve(to_vertices);
  const Eigen::VectorXd left =
      Eigen::VectorXd::Ones(to_vertices.cols()) - solved.transpose() * ones;
  Marginals marginals;
  marginals.mean = constant * Eigen::VectorXd::Ones(to_vertices.cols()) +
                   solved.transpose() * (readings - constant * ones);
  marginals.variance = (4.0 - to_vertices.cwiseProduct(solved).colwise().sum().transpose().array() +
                        left.array().square() / precision)
                           .matrix();
  return marginals;
}

void expect_alike(const Marginals& a, const Marginals& b, double tolerance) {
  EXPECT_LE((a.mean - b.mean).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((a.variance - b.variance).cwiseAbs().maxCoeff(), tolerance);
}

std::string repeats(int places, int times) {
  Random random(5);
  std::string rows = "x,y,z,reading,noise_variance\n";
  for (int i = 0; i < places * times; ++i) {
    const int place = i % places;
    rows += text_of(0.002 + 0.003 * (place % 6)) + "," + text_of(0.002 + 0.004 * (place / 6)) +
            ",0," + text_of(7.0 + random.normal()) + "," +
            (i % 3 == 0 ? "" : text_of(0.01 + 0.1 * random.uniform())) + "\n";
  }
  return rows;
}

// Readings of order 7, variances of order 4, condition about 1e3: 1e-12 is a hundred roundings.
TEST(MeasuredBelief, S02RepeatsAreOnePlaceAndTheWholeModelsAnswer) {
  const Surface surface = tissue();
  const std::vector<Palpation> palpations = read(surface, repeats(/*places=*/24, /*times=*/5));
  const Belief belief = believe(surface, palpations);
  EXPECT_EQ(belief.site_count(), 24);
  expect_alike(belief.at_vertices(), whole_model(surface, palpations), 1e-12);
}

// Ten thousand readings of noise s are one reading of their mean and noise s / 100.
TEST(MeasuredBelief, S04TenThousandRepeatsAreOnePlaceAndTheirMean) {
  const Surface surface = tissue();
  Random random(6);
  const std::string others = "0.005,0.015,0,8,\n0.016,0.004,0,6.5,\n";
  std::string many = "x,y,z,reading,noise_variance\n" + others;
  long double sum = 0.0L;
  for (int i = 0; i < 10000; ++i) {
    const double reading = 7.0 + kNoise * random.normal();
    sum += reading;
    many += "0.011,0.009,0," + text_of(reading) + ",\n";
  }
  const std::string one = "x,y,z,reading,noise_variance\n" + others + "0.011,0.009,0," +
                          text_of(static_cast<double>(sum / 10000.0L)) + "," +
                          text_of(kNoise * kNoise / 10000.0) + "\n";
  const Belief belief = believe(surface, read(surface, many));
  EXPECT_EQ(belief.site_count(), 3);
  expect_alike(belief.at_vertices(), believe(surface, read(surface, one)).at_vertices(), 1e-12);
}

// Four hundred repeats at one place against the model that has a row for each of them.
TEST(MeasuredBelief, S04RepeatsAtOnePlaceAreTheWholeModelsAnswer) {
  const Surface surface = tissue();
  Random random(7);
  std::string text = "x,y,z,reading\n0.005,0.015,0,8\n0.016,0.004,0,6.5\n";
  for (int i = 0; i < 400; ++i)
    text += "0.011,0.009,0," + text_of(7.0 + kNoise * random.normal()) + "\n";
  const std::vector<Palpation> palpations = read(surface, text);
  expect_alike(believe(surface, palpations).at_vertices(), whole_model(surface, palpations), 1e-12);
}

TEST(MeasuredBelief, S05PlacesAPicometreApartAreOneWithNoiseAndWithout) {
  const Surface surface = tissue();
  for (const char* variance : {"", "0"}) {
    const std::string end = std::string(",") + variance + "\n";
    const std::vector<Palpation> near =
        read(surface, "x,y,z,reading,noise_variance\n0.01,0.012,0,7" + end +
                          "0.010000000001,0.012,0,7" + end + "0.003,0.004,0,8" + end);
    const std::vector<Palpation> same =
        read(surface, "x,y,z,reading,noise_variance\n0.01,0.012,0,7" + end + "0.01,0.012,0,7" +
                          end + "0.003,0.004,0,8" + end);
    const Belief belief = believe(surface, near);
    EXPECT_EQ(belief.site_count(), 2);
    expect_alike(belief.at_vertices(), believe(surface, same).at_vertices(), 0.0);
  }
}

TEST(MeasuredBelief, S08AVertexAndAnEdgeArePlacesThatDoNotDependOnTheRow) {
  const Surface surface = tissue();
  const std::vector<Palpation> palpations = read(
      surface,
      "x,y,z,reading\n0.01,0.01,0,7\n0.00625,0.005,0,7\n0.01,0.01,0.001,8\n0.00625,0.005,0,9\n");
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(palpations[i].where.face, palpations[i + 2].where.face);
    EXPECT_EQ(palpations[i].where.barycentric, palpations[i + 2].where.barycentric);
  }
  EXPECT_EQ(palpations[0].where.barycentric.maxCoeff(), 1.0) << "a vertex carries all the weight";
  EXPECT_EQ(palpations[1].where.barycentric.minCoeff(), 0.0)
      << "the corner off the edge carries none";
}

// Mean of order 1e9, where a rounding is 1e-7: the belief is about the readings' differences, so it
// loses no more than that.
TEST(MeasuredBelief, S12AnOffsetOfAThousandMillionChangesNothingButTheMean) {
  const Surface surface = tissue();
  std::string plain = "x,y,z,reading\n", offset = plain;
  for (int i = 0; i < 36; ++i) {
    const std::string place =
        text_of(0.002 + 0.003 * (i % 6)) + "," + text_of(0.002 + 0.003 * (i / 6)) + ",0,";
    const int step = i * 7 % 13;
    plain += place + std::to_string(step) + "\n";
    offset += place + std::to_string(1000000000 + step) + "\n";
  }
  const Marginals a = believe(surface, read(surface, plain)).at_vertices(),
                  b = believe(surface, read(surface, offset)).at_vertices();
  EXPECT_LE((b.mean.array() - 1e9 - a.mean.array()).abs().maxCoeff(), 5e-7);
  EXPECT_EQ(a.variance, b.variance);
}

TEST(MeasuredBelief, S14NegatedReadingsNegateTheMean) {
  const Surface surface = tissue();
  const std::vector<Palpation> palpations = read(surface, repeats(10, 1));
  std::vector<Palpation> negated = palpations;
  for (Palpation& palpation : negated) palpation.reading = -palpation.reading;
  const Marginals a = believe(surface, palpations).at_vertices(),
                  b = believe(surface, negated).at_vertices();
  EXPECT_EQ(a.mean, -b.mean);
  EXPECT_EQ(a.variance, b.variance);
}

TEST(MeasuredBelief, S16TheOrderOfRowsDoesNotChangeTheAnswer) {
  const Surface surface = tissue();
  const std::vector<Palpation> palpations = read(surface, repeats(24, 3));
  const std::vector<Palpation> reversed(palpations.rbegin(), palpations.rend());
  expect_alike(believe(surface, palpations).at_vertices(), believe(surface, reversed).at_vertices(),
               1e-12);
}

TEST(MeasuredBelief, S19NoReadingLeavesThePriorsAnswer) {
  const Surface surface = tissue();
  const Marginals marginals = believe(surface, read(surface, "x,y,z,reading\n")).at_vertices();
  EXPECT_EQ(marginals.mean, Eigen::VectorXd::Zero(surface.vertex_count()));
  EXPECT_EQ(marginals.variance,
            Eigen::VectorXd::Constant(surface.vertex_count(), 4.0));  // 2 squared
}

}  // namespace
}  // namespace palpation
