/// How much memory a piece of work takes at its peak, beyond what was held before.
#pragma once

#include <optional>

namespace palpation::tool {

class PeakMemory {
 public:
  /// Starts to watch, for the whole process: one at a time.
  PeakMemory();

  /// Since it was made; nothing where the system does not tell (it takes Linux's
  /// /proc/self/clear_refs).
  std::optional<double> megabytes() const;

 private:
  std::optional<double> before_;
};

}  // namespace palpation::tool
