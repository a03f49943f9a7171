/// The logarithm of a mean, of numbers that are given by theirs.
#pragma once

#include <cmath>
#include <limits>

namespace palpation {

class LogMean {
 public:
  void add(double logarithm) {
    ++count_;
    if (logarithm > largest_) {
      others_ = std::isinf(largest_) ? 0.0 : (1.0 + others_) * std::exp(largest_ - logarithm);
      largest_ = logarithm;
    } else if (std::isfinite(largest_)) {
      others_ += std::exp(logarithm - largest_);
    }
  }

  /// Minus infinity without any that is above.
  double value() const { return largest_ + std::log1p(others_) - std::log(count_); }

 private:
  double count_ = 0.0;
  double largest_ = -std::numeric_limits<double>::infinity();
  double others_ = 0.0;  ///< the sum of the others, over the largest
};

}  // namespace palpation
