/// Long work that can be ended from outside: by Ctrl-C in an interpreter, by whoever stops a robot.
///
///     const Interruptible scope([&] { if (stop_is_asked) throw Stopped(); });
///     exploration.record(felt);
///
/// What the function throws ends the work like any error: values stay as they were, and what a
/// surface computes once is computed anew when it is next asked for. The work calls it now and
/// then, in the thread that made the scope and in no other: mostly within a tenth of a second,
/// seldom (a large factorization, a large chart) after some seconds.
#pragma once

#include <functional>

namespace palpation {

class Interruptible {
 public:
  /// For this thread, until it is destroyed; of nested ones the innermost counts. What `check`
  /// throws should be no std::exception, which a step may take for its own failure.
  explicit Interruptible(std::function<void()> check);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  friend void check_interruption();

  std::function<void()> check_;
  const Interruptible* outer_;
};

/// Calls this thread's check, if there is one.
void check_interruption();

}  // namespace palpation
