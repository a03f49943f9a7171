/// Neumaier's sum: what each step rounds away is kept apart, or a fine mesh would lose an area of
/// some of its faces.
#pragma once

#include <cmath>

namespace palpation {

class CarefulSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

}  // namespace palpation
