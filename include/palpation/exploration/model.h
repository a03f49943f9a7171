/// What is taken for true of tissue, probe and tumour before anything is concluded from readings.
#pragma once

#include <optional>

#include "palpation/base/learnable.h"
#include "palpation/belief/belief.h"
#include "palpation/readings/reading_scale.h"

namespace palpation {

/// How the field goes together from place to place.
struct KernelModel {
  KernelFamily family = KernelFamily::SquaredExponential;
  Learnable length_m = kLearned;
  Learnable signal_sd = kLearned;  ///< as Kernel has it
  double length_median_m =
      0.0035;             ///< of the prior of a length that is learned (hyperparameters.h)
  double period_m = 0.0;  ///< of the periodic kernel

  bool operator==(const KernelModel&) const = default;
};

/// The kernel before any reading: for what is learned its prior's median stands in.
Kernel kernel_of(const KernelModel& model);

/// What all readings have in common.
struct Trend {
  Constant constant{};
  /// The field has a slope (prior.h), which tilts and drifts add; it joins once fifteen places are
  /// touched, and until then nothing is concluded. Level and boundary are of the field without it.
  bool is_linear = false;

  bool operator==(const Trend& other) const {
    return constant.sd == other.constant.sd && is_linear == other.is_linear;
  }
};

/// Of readings whose own noise is not given.
struct NoiseModel {
  Learnable sd = kLearned;
  bool is_relative = false;  ///< sd, which is given, is a fraction of the kernel's signal_sd

  bool operator==(const NoiseModel&) const = default;
};

/// What a probe does to what is felt.
struct ProbeModel {
  Learnable lag_m = 0.0;           ///< how late readings come (lag.h)
  double indenter_radius_m = 0.0;  ///< of a round tip, which feels edges by as much too early:
                                   ///< boundary and band lie that much inwards
  /// The readings are scans whose rows may jam, start up or step (screened of screening.h), or fade
  /// to one side: tissue that is stiff along a row, or half of it, would be taken for such. What no
  /// tissue gives (plausible) is set aside in any case. Judged anew after every batch.
  bool screening = false;

  bool has_lag() const { return lag_m != Learnable(0.0); }

  bool operator==(const ProbeModel&) const = default;
};

/// What is saved, and what it costs.
struct Economy {
  double reduced_rank_tolerance = 0.0;  ///< as BeliefOptions has it
  bool single_precision = false;        ///< as BeliefOptions has it
  /// Nats of log posterior that learned hyperparameters may miss of the best ones: they are rounded
  /// (LearnOptions::rounding_nats), so that readings that teach the same again let the field grow
  /// by themselves alone. 0: always the best ones. Only where nothing but the hyperparameters moves
  /// old readings: no lag, screening or trend, a constant that is not zero, and
  /// touches at stops.
  double rebuild_gain = 0.0;

  bool operator==(const Economy&) const = default;
};

/// How the field is modelled. What is to be learned is learned anew after every batch.
struct FieldModel {
  Metric metric = Metric::Chart;
  KernelModel kernel{};
  Trend trend{};
  NoiseModel noise{};
  bool standardize = false;  ///< as BeliefOptions has it; where anything is learned, it only
                             ///< centres a field of zero mean on the readings' mean
  ProbeModel probe{};
  Economy economy{};

  bool learns() const {
    return kernel.length_m.is_learned() || kernel.signal_sd.is_learned() || noise.sd.is_learned();
  }
  bool is_noiseless() const { return noise.sd == Learnable(0.0); }

  bool operator==(const FieldModel&) const = default;
};

/// What the level is estimated from, where it is not known: the range of the mean (the paper's
/// way), or the profile of the readings across the edge (edge_profile.h), which knows how sure it
/// is.
enum class LevelEstimate { Range, Edge };

/// How the level is found.
struct LevelRule {
  std::optional<double> known{};  ///< in reading units
  double fraction = 0.5;          ///< of the way from the low plateau to the high one
  LevelEstimate estimate = LevelEstimate::Edge;

  /// Whether it is to be told by the tumour's edge.
  bool is_of_edge() const { return !known && estimate == LevelEstimate::Edge; }

  bool operator==(const LevelRule&) const = default;
};

/// What counts as a tumour's contrast.
struct Contrast {
  /// Of the readings, before a field is fitted to them. Nothing: logarithms where some readings are
  /// twice as high as others and an edge, and the noise about it, are more probable that way
  /// (Evidence::scale); never where level, `least`, signal, noise or the trend's constant are
  /// given, which are in the readings' unit then.
  std::optional<ReadingScale> scale{};
  /// Above healthy tissue, in the readings' unit (with ReadingScale::Log a factor): what surely
  /// stands out by less is texture, a vessel, a slow wave, and no tumour. Nothing: whatever stands
  /// out.
  std::optional<double> least{};
  /// Until the readings show contrast (contrast.h), conclude nothing, explore by the field's
  /// variance, and where the field is learned, which five readings of healthy tissue would teach
  /// that noise is all, by that of a field of the prior's length, with a second look where readings
  /// were high. Not asked of a field and a level that are both given.
  bool safe_start = true;

  bool operator==(const Contrast&) const = default;
};

/// Between whose two curves the whole true outline lies.
struct Band {
  double probability = 0.95;
  /// Standard deviation of where the readings lie along the tissue, all off the same way: what a
  /// registration to the robot's frame leaves open. The band is wider by it.
  double place_sd_m = 0.0;

  bool operator==(const Band&) const = default;
};

struct Model {
  FieldModel field{};
  LevelRule level{};
  /// Nothing: the boundary alone is asked for, no band, cut line, probabilities or expected error.
  std::optional<Band> band = Band{};
  Contrast contrast{};

  bool needs_contrast() const { return contrast.safe_start && (field.learns() || !level.known); }

  bool operator==(const Model&) const = default;
};

/// Throws InvalidInput unless the level's fraction and the band's probability lie in (0, 1), its
/// place_sd_m is finite and not negative, and the least contrast is positive, or as a factor above
/// 1, of a scale that is given.
void check(const Model& model);

}  // namespace palpation
