/// How high tissue lies over a smooth reference surface, from contacts with it, and how sure that
/// is.
///
/// The height of a contact is its offset along the reference's normal from the closest point; a
/// Gaussian process (Matern 5/2 of the straight distance, mean zero) of that height is
/// conditioned on all contacts, of more than `most_sites` on the means of groups (thin.h). Its
/// length, signal and noise are those of greatest likelihood over patches of neighbours, the length
/// at least 1.5 distances of contacts: what is narrower cannot be told from noise. The
/// surface is the reference plus the mean: it is as smooth as that says, and nothing else is
/// smoothed.
///
/// What a fit to a likelihood does not promise is made so by leaving one out: standard deviations
/// are scaled until 95 % of the sites lie within 1.96 of what all others say. So a contact made
/// again lies within 1.96 sqrt(height_sd^2 + contact_sd^2) of the surface with a probability of
/// 95 %, contact_sd being the scatter of single contacts about it.
///
/// Contacts beside the reference by more than `reach_m` lie beyond its border and are left out;
/// so are outliers: those more than 5 standard deviations off what the others say.
#pragma once

#include <vector>

#include "palpation/belief/hyperparameters.h"

namespace palpation {

struct HeightOptions {
  double spacing_m = 0.0;  ///< between contacts: where the search for the length starts
  double reach_m = 0.0;
  double noise_sd_m = 0.0;  ///< of a site: by how much the surface may miss it; 0: learned
  int most_sites = 2500;
};

struct HeightFit {
  TriangleMesh mesh;          ///< the reference, its vertices moved to the mean height
  Field height_sd;            ///< at each vertex, along the normal, metres
  Hyperparameters learned;    ///< metres; the noise is of a site
  double calibration = 1.0;   ///< by which standard deviations were scaled; .5 to 3
  double contact_sd = 0.0;    ///< of a single contact about the surface, metres
  int sites = 0;              ///< that the process was conditioned on
  std::vector<int> outliers;  ///< contacts left out, rising
  std::vector<int> beyond;    ///< contacts beyond the border, rising
};

/// Throws InvalidInput unless contacts are finite, spacing_m and reach_m positive and finite and
/// most_sites at least 12, and NumericalError where fewer than 12 contacts are left, or as learn.
HeightFit fit_height(const Surface& reference, const Points& contacts,
                     const HeightOptions& options);

}  // namespace palpation
