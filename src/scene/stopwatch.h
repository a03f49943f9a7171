/// How long things take.
#pragma once

#include <chrono>
#include <ctime>
#include <vector>

namespace palpation::tool {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds that this thread had a processor since it was made.
class CpuStopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_ = now();
};

struct BatchStopwatch {
  Stopwatch wall;
  CpuStopwatch cpu;
};

/// Seconds of a run.
struct RunTimes {
  /// Until the field could take readings: an intrinsic one finds the surface's waves.
  double start = 0.0;
  /// Each batch's, planning and updating, the boundary and its error included.
  std::vector<double> batches{};
  std::vector<double> batches_cpu{};  ///< the same, of this thread's processor

  /// A batch has ended; the next one begins.
  void end_batch(BatchStopwatch& stopwatch) {
    batches.push_back(stopwatch.wall.seconds());
    batches_cpu.push_back(stopwatch.cpu.seconds());
    stopwatch = BatchStopwatch();
  }
};

}  // namespace palpation::tool
