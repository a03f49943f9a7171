/// A belief from readings: what is to be learned is learned.
#pragma once

#include <span>

#include "palpation/belief/hyperparameters.h"
#include "palpation/exploration/conclusion.h"

namespace palpation {

/// A belief to start from: what is learned has no value yet, so the priors' medians stand in.
Belief unlearned(const Surface& surface, const FieldModel& field);

/// A belief of fixed hyperparameters from all readings, with the slope where it is modelled and may
/// join.
Belief fixed_field(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations);

/// Most readings that hyperparameters are learned from where some were made on the way: stops
/// number a few hundred, readings on the way thousands, and the cost grows with the third power.
/// All of them count in the belief.
inline constexpr std::size_t kMostToLearnFrom = 150;

/// Log likelihood ratio of a belief of fixed hyperparameters to noise alone, as LearnedField has
/// it, around a constant that is not known: of three hundred readings where there are more, since a
/// tumour shows in those, and the cost grows with the third power. 0 where they determine no such
/// field in double precision.
double evidence_of_fixed(const Belief& belief, std::span<const Palpation> palpations);

/// What readings teach: the belief before them.
struct LearnedField {
  Belief blank;
  Hyperparameters learned;       ///< reading units; where to start from where nothing is taught
  double signal_evidence = 0.0;  ///< log likelihood ratio of this field to noise alone around a
                                 ///< constant, or around a plane
  bool taught = false;
  bool from_some = false;  ///< not from all readings

  Hyperparameters in_force() const;
};

/// The hyperparameters that the readings teach, searched from the priors' medians and, where there
/// is one, from `start`; from fewer than two places, or readings that are all alike, nothing is
/// learned. Of readings on the way only every so many counts where there are more than
/// `most_places` in all, and of stops where they are more than that and six hundred.
LearnedField learn_field(const Surface& surface, const FieldModel& field,
                         std::span<const Palpation> palpations, const Hyperparameters& start = {},
                         std::size_t most_places = kMostToLearnFrom);

struct FieldFit {
  Belief belief;
  double signal_evidence = 0.0;
  std::vector<Palpation> one_by_one{};  ///< its readings, where it knows some of them together
};

/// The belief that knows them too, those on the way, and stops where they are more than six
/// hundred, merged within three tenths of the length that a field is likely to have where they are
/// alike but for noise. Where readings that did not teach are too close together for the noise that
/// was learned, all teach.
FieldFit belief_of(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations, const LearnedField& taught);

/// Both.
FieldFit fit_field(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations);

/// Whether a belief in these readings grows by what is felt: neither hyperparameters that are
/// always the best (Economy::rebuild_gain) nor anything else that others teach moves readings that
/// are known already.
bool grows(const FieldModel& field, std::span<const Palpation> palpations);

/// The belief of a field that grows, from what is known of it already.
FieldFit grown_field(const Surface& surface, const FieldModel& field,
                     std::span<const Palpation> palpations, ConclusionCache& cache);

}  // namespace palpation
