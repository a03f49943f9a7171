/// How much a touch at each vertex is worth. The field's published criteria, and room for your own:
///
///     const Acquisition mine = Pointwise{.score = [](double mean, double sd, const Level& h) {
///     return sd * std::exp(-std::abs(mean - h.value)); },
///                                        .grows_with_stddev = true};
#pragma once

#include <cstdint>
#include <functional>
#include <variant>

#include "palpation/belief/belief.h"
#include "palpation/belief/level.h"

namespace palpation {

enum class Scaling {
  Raw,       ///< as the paper writes it
  MaxScaled  ///< as the authors' code has it: each term over its maximum
};

/// What a pointwise criterion is given. Maxima are taken over the candidates when a batch begins,
/// and stay.
enum class Units {
  Readings,              ///< mean and stddev as they are
  OverGreatestDistance,  ///< stddev over its maximum; mean moved towards the level, so that the
                         ///< greatest distance from it is 1
  OverGreatestMean       ///< stddev over its maximum, mean over its greatest magnitude
};

/// A criterion of the mean and the standard deviation (not the variance) at a vertex.
struct Pointwise {
  std::function<double(double mean, double stddev, const Level& level)> score;
  bool grows_with_stddev = false;  ///< promised never to fall when stddev grows: the batch may then
                                   ///< be chosen lazily, with the same picks
  Units units = Units::Readings;
};

/// A criterion of the whole belief: one score per vertex, evaluated anew for every pick, with the
/// earlier picks' readings taken as their means.
struct Whole {
  std::function<Field(const Belief& belief, const Level& level)> scores;
};

using Acquisition = std::variant<Pointwise, Whole>;

/// Expected variance reduction: stddev (Garg et al. 2016, section V.1).
Pointwise evr();

/// Upper confidence bound: gamma mean + (1 - gamma) stddev (section V.2). Throws InvalidInput
/// unless 0 <= gamma <= 1.
Pointwise ucb(double gamma = 0.5, Scaling scaling = Scaling::Raw);

/// Implicit level set UCB: (1 - gamma) stddev - gamma |mean - level| (section V.3). Throws
/// InvalidInput unless 0 <= gamma <= 1.
Pointwise ils_ucb(double gamma = 0.5, Scaling scaling = Scaling::Raw);

/// Straddle: width stddev - |mean - level| (Bryan et al. 2005).
Pointwise straddle(double width = 1.96);

/// LSE's ambiguity: min(upper - level, level - lower) of the confidence interval mean +- width
/// stddev; what is already classified (ambiguity below 0) ranks by how nearly it is not (Gotovos et
/// al. 2013, without its intersection of intervals over time).
Pointwise lse_ambiguity(double width = 3.0);

/// Straddle of a width drawn anew for every pick, its square from the chi-squared distribution of
/// two degrees of freedom: no width to tune (Inatsu, Takeno, Kutsukake and Takeuchi 2024). The same
/// seed and number of touches draw the same widths.
Whole randomized_straddle(std::uint64_t seed);

/// How much a touch lowers the expected symmetric difference, m2: a vertex stays misjudged with
/// probability 2 T(|score|, b / sqrt(1 - b^2)), T Owen's function, b the ratio of the standard
/// deviations after and before. Looked at for the 200 vertices that straddle likes best; the others
/// score 0.
Whole expected_symmetric_difference();

/// Scores drawn anew for every pick: touches at random. The same seed and number of touches draw
/// the same scores.
Whole random_scores(std::uint64_t seed);

/// The scores of all vertices as the first pick of a batch sees them: for pictures.
Field score(const Acquisition& acquisition, const Belief& belief, const Level& level);

}  // namespace palpation
