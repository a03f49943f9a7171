// The exact belief of very many places: how well it solves its own equations.
//
//   sweep_many_places N      touches N vertices of a plane that has few more; 10,000 take 3 GB and
//   half a minute
//
// With alpha = (y - mean) / s2 at the places touched, (K + s2 I) alpha = y. LAPACK's measure of
// what is left of that, over n eps |K + s2 I| |alpha| in greatest row sums, must be below 30.
// (Noise much below this one magnifies, in alpha, the rounding of the mean.)

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "palpation/belief/belief.h"
#include "palpation/geometry/make_plane.h"

using namespace palpation;

constexpr double kNoiseSd = 0.1;

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1500;
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  Random random(5);
  const Surface surface(make_plane({.columns = side, .rows = side, .jitter = 0.2}, random));
  const Prior prior(surface, Metric::Chart, {.length_m = 0.0033}, {.sd = 0.0});
  std::vector<Palpation> readings;
  Eigen::VectorXd y(count);
  for (int vertex = 0; vertex < count; ++vertex) {
    y[vertex] = std::sin(300.0 * surface.vertex(vertex).x()) + kNoiseSd * random.normal();
    Palpation palpation;
    palpation.where = surface.at_vertex(vertex);
    palpation.reading = y[vertex];
    readings.push_back(palpation);
  }
  const Field mean =
      Belief(prior, {.noise_sd = kNoiseSd}).condition_on(readings).at_vertices().mean;
  const Eigen::VectorXd alpha = (y - mean.head(count)) / (kNoiseSd * kNoiseSd);
  double rest = 0.0, greatest_row = 0.0;
  for (int i = 0; i < count; ++i) {
    long double product = static_cast<long double>(kNoiseSd * kNoiseSd) * alpha[i];
    double row = kNoiseSd * kNoiseSd;
    for (int j = 0; j < count; ++j) {
      const double k = correlation(prior.kernel(), prior.coordinates(i) - prior.coordinates(j));
      product += static_cast<long double>(k) * alpha[j];
      row += k;
    }
    rest = std::max(rest, std::abs(static_cast<double>(product - y[i])));
    greatest_row = std::max(greatest_row, row);
  }
  const double ratio = rest / (count * std::numeric_limits<double>::epsilon() * greatest_row *
                               alpha.cwiseAbs().maxCoeff());
  std::printf("%d places: what is left is %.2g times n eps |K| |alpha|\n", count, ratio);
  return ratio < 30.0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
