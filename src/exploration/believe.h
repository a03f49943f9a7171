/// From readings to the field, and whether it shows more than noise.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "palpation/exploration/conclusion.h"

namespace palpation {

/// What readings make of the field.
struct Believed {
  std::vector<Palpation> palpations;  ///< as they were made, with the reason where set aside
  Belief belief;
  std::optional<Lag> lag;
  Evidence evidence;
  /// Nats by which the field, with what it has learned, makes the readings more probable than noise
  /// alone; nothing where it was not learned.
  std::optional<double> of_smooth_field{};
  /// Where they belong, if the belief knows some of them together (FieldFit).
  std::vector<Palpation> one_by_one{};
};

/// The readings as they were made, with the reasons why some are set aside.
std::vector<Palpation> as_made(std::vector<Palpation> felt, std::span<const Palpation> believed);

/// `all`: readings that were made, none of them missed.
Believed believe(const Surface& surface, const Model& model, std::vector<Palpation> all,
                 ConclusionCache& cache);

}  // namespace palpation
