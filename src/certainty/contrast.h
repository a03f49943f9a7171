/// Whether readings show more than noise.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

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

/// Whether a smooth field explains the readings better than noise alone by five nats.
bool shows_field(double signal_evidence);

/// The same, or two plateaus do: a tumour that few touches hit shows in their values before it
/// shows in where they are. Noise alone passes in fewer than one run in a hundred.
bool shows_contrast(std::span<const double> readings, double signal_evidence);

/// The one reading that lies farther from all others than they lie from each other: a fault, or the
/// one touch that hit something.
struct LoneReading {
  std::size_t number = 0;
  double spans = 0.0;  ///< how far from the nearest other, over how far the others lie from each
                       ///< other: above 1, may be infinite
};

/// Nothing for fewer than thirty readings, where a tumour may well have been hit but once.
std::optional<LoneReading> lone_reading(std::span<const double> readings);

}  // namespace palpation
