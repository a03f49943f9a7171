/// A belief from readings: what is to be learned is learned.
#pragma once

#include <span>

#include "palpation/exploration/exploration.h"

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
  double gain = 0.0;       ///< of log posterior over that at the start

  Hyperparameters in_force() const;
};

/// The hyperparameters that the readings teach, searched from `start`; from fewer than two places,
/// or readings that are all alike, nothing is learned. Of readings on the way only every so many
/// counts where there are more than `most_places` in all.
LearnedField learn_field(const Surface& surface, const FieldModel& field,
                         std::span<const Palpation> palpations, const Hyperparameters& start,
                         std::size_t most_places = kMostToLearnFrom);

struct FieldFit {
  Belief belief;
  Hyperparameters learned;
  double signal_evidence = 0.0;
};

/// The belief that knows them too, those on the way merged within three tenths of the length that a
/// field is likely to have. Where readings that did not teach are too close together for the noise
/// that was learned, all teach.
FieldFit believe(const Surface& surface, const FieldModel& field,
                 std::span<const Palpation> palpations, const LearnedField& taught);

/// Both.
FieldFit fit_field(const Surface& surface, const FieldModel& field,
                   std::span<const Palpation> palpations, const Hyperparameters& start);

/// Whether readings that are known already count otherwise once others come, hyperparameters apart.
bool restates_known_readings(const FieldModel& field);

/// Whether a belief of this field may grow by what is felt, under hyperparameters that are nearly
/// the best (Economy::rebuild_gain).
bool may_grow(const FieldModel& field);

/// As fit_field, of a field that may grow: what was learned before stays, and the belief in force
/// grows by the last of the readings, unless other hyperparameters gain enough, or some readings
/// were made on the way.
FieldFit grow_field(const Surface& surface, const FieldModel& field,
                    std::span<const Palpation> palpations, const Belief& in_force,
                    const Hyperparameters& learned);

}  // namespace palpation
