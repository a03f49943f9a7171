/// How good a boundary can be: a reference for every method, computed from the truth.
///
/// Cramer and Rao's bound for a closed outline that is known to be smooth: its offset along the
/// normal has P modes, as many as lengths of 4.5 mm in the perimeter. Every reading is where it
/// tells most. With noise s (a fraction of the plateaus' difference), slope k and level fraction f,
/// a reading on the boundary locates it to s / (k f (1 - f)), and of n readings the share w is
/// spent on the plateaus, which tell the level, w being the best of whole twentieths (close to 1 /
/// (sqrt(P) + 1); 0 where the plateaus are known):
///
///     sd(offset) = s / (k f (1 - f)) sqrt((P / (1 - w) + 1 / w) / n)        (plateaus known:
///     sqrt(P / n)), E|wrong area| = perimeter sqrt(2 / pi) sd(offset).
///
/// A reference at a fixed number of modes, no strict bound: an estimator that prefers smooth
/// outlines may be better on smooth ones.
#pragma once

namespace palpation {

struct ReferenceCase {
  double perimeter_m = 0.0;     ///< of the true outline, all its pieces together
  double slope_per_m = 1400.0;  ///< of the sigmoid across the edge
  double noise = 0.05;          ///< of a reading, as a fraction of the plateaus' difference
  int readings = 105;
  double fraction = 0.5;  ///< of the level between the plateaus
  bool plateaus_known = false;
};

struct ReferenceBound {
  int modes = 1;  ///< P
  double offset_sd_m = 0.0;
  double expected_error_m2 = 0.0;

  /// With this probability the whole outline lies no farther than this from its estimate: P
  /// independent offsets at once, each normal, are within z sd where Phi(z) - Phi(-z) =
  /// probability^(1/P). Throws InvalidInput unless 0 < probability < 1.
  double band_half_width_m(double probability = 0.95) const;
};

/// Throws InvalidInput unless perimeter and slope are positive and finite, the noise finite and not
/// negative, readings positive and the fraction in (0, 1).
ReferenceBound reference_bound(const ReferenceCase& of);

}  // namespace palpation
