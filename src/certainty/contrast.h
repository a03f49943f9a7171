/// Whether readings show more than noise.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace palpation {

/// Readings as two plateaus with normal noise about them.
struct TwoPlateaus {
  double low = 0.0;
  double high = 0.0;
  double evidence = 0.0;  ///< log likelihood ratio, in nats, to one plateau
};

/// The best of several splits, improved by expectation and maximization. At most half the readings,
/// and at least one, lie on the high plateau. Nothing for fewer than ten readings, or none that
/// differ.
std::optional<TwoPlateaus> two_plateaus(std::span<const double> readings);

/// The same of those that were made so many apart, which errors that last leave independent: the
/// mean evidence over where one begins.
double evidence_of_two_plateaus_in_turn(std::span<const double> readings, std::size_t apart);

/// Whether a smooth field explains the readings better than noise alone by five nats.
bool shows_field(double signal_evidence);

/// The same, or two plateaus do: a tumour that few touches hit shows in their values before it
/// shows in where they are. Noise alone passes in fewer than one run in a hundred, also where a
/// sensor rounds it to a few values.
bool shows_contrast(std::span<const double> readings, double signal_evidence);

/// Few readings that lie farther from all others than those lie from each other: faults, or the
/// few touches that hit something.
struct ReadingsApart {
  std::vector<std::size_t> numbers{};  ///< rising
  double spans = 0.0;  ///< how far the nearest of them is from the others, over how far those lie
                       ///< from each other: above 1, may be infinite
};

/// As many as there are, `most` of them at most. Nothing for fewer than thirty readings, where a
/// tumour may well have been hit but once.
std::optional<ReadingsApart> readings_apart(std::span<const double> readings, std::size_t most);
/// One in twenty; but one is always few.
std::size_t few_of(std::size_t readings);

}  // namespace palpation
