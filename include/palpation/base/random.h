/// A stream of random numbers that is the same on every machine: its own generator, its own
/// distributions.
///
/// xoshiro256** (Blackman and Vigna 2021), seeded by splitmix64. Always an argument (`Random&`),
/// never a global.
#pragma once

#include <array>
#include <cstdint>

namespace palpation {

class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// Next 64 random bits.
  std::uint64_t bits();

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform();

  /// Uniform in {0, ..., count - 1}, without bias. Throws InvalidInput unless count > 0.
  int below(int count);

  /// Standard normal (Marsaglia's polar method).
  double normal();

  /// A stream of its own, for a part of the work whose length must not disturb the rest.
  Random split();

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace palpation
