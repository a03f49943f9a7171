/// A simulated phantom: equation (4) of Garg et al. 2016 on any surface.
///
///     Y(x) = low + (high - low) / (1 + exp(-slope d(x) - ln(f / (1 - f)))) + bias x1 (high - low)
///     + noise,
///
/// d the signed distance to the true outline (positive inside), f the level's fraction, x1 running
/// from 0 to 1 along the bias axis over the tissue. A reading made while the probe travels comes
/// late: at x, along the unit vector t, it is of the place x - lag t. The shift by f makes the true
/// outline the contour at low + f (high - low); at f = 1/2 it is the paper's formula as printed.
#pragma once

#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"
#include "palpation/world/lump.h"
#include "palpation/world/tumour.h"

namespace palpation {

struct StiffnessModel {
  double low = 7.0;   ///< reading on healthy tissue
  double high = 9.0;  ///< reading deep inside a tumour
  double slope_per_m = 1400.0;
  double noise = 0.0;             ///< standard deviation as a fraction of high - low
  double bias = 0.0;              ///< the paper's beta
  Vec3 bias_axis = Vec3::Zero();  ///< zero: the longest side of the tissue's bounding box
  double fraction = 0.5;          ///< of the level, in (0, 1)
  double lag_m = 0.0;             ///< below 0: readings come early
};

/// Tissue of which more is known than that: lumps of their own contrast and profile, the stiffest
/// of which is felt where they overlap, on a background that is added.
struct PhantomDesign {
  std::vector<Lump> lumps{};
  std::vector<Background> background{};
  StiffnessModel model{};
};

class Phantom {
 public:
  /// Throws InvalidInput if the model is not finite, high <= low, slope <= 0, noise < 0, the
  /// fraction is outside (0, 1) or the bias axis at a right angle to the whole tissue, and as
  /// signed_distance.
  Phantom(Surface surface, std::vector<Tumour> tumours, const StiffnessModel& model);

  /// Throws as the other and background_field, and unless contrasts and steepnesses are positive
  /// and finite.
  Phantom(Surface surface, const PhantomDesign& design);

  /// Free of noise, bias and background, at the vertices, every lump as if of full contrast: its
  /// superlevel set at true_level() is the true region, in which each lump ends at the level's
  /// fraction of its own way.
  const Field& truth() const { return truth_; }
  double true_level() const;

  /// A reading: bias and noise included; its noise variance is left to the field. Inside a face the
  /// signed distance is linear. Every touch draws one normal, even without noise, so that runs at
  /// several noise levels feel the same fluctuations.
  Palpation touch(const SurfacePoint& where, Random& random) const;
  /// The same while travelling along a unit vector, or resting where it is zero. The place that is
  /// felt is the tissue's closest point to x - lag t; the palpation is said to be at x.
  Palpation touch(const SurfacePoint& where, const Vec3& travel, Random& random) const;

 private:
  /// Lumps that are felt alike, or one that is not.
  struct Layer {
    Field depth;
    Lump like;
    double greatest_depth_m;
    Vec3 deepest;
  };
  void add_layer(std::vector<Lump> lumps);
  /// Of high - low and what is low, at a depth below a place.
  double stiffness(const Layer& layer, double depth_m, const Vec3& place, double contrast) const;

  Surface surface_;
  StiffnessModel model_;
  std::vector<Layer> layers_;
  Field bias_;        // x1 in [0, 1] at the vertices
  Field background_;  // in units of high - low; empty where there is none
  Field truth_;
};

}  // namespace palpation
