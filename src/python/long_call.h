/// Calls into the library that may take long: other Python threads run meanwhile, and Ctrl-C ends
/// them.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <optional>
#include <type_traits>

#include "palpation/base/interruption.h"

namespace palpation::python {

/// What ends the work inside the library; no std::exception, so that no step takes it for its own
/// failure.
struct Stopped {};

/// Why the work of this thread is to end: a signal's handler raised, or a function of the caller's
/// that the library called. Made and destroyed with the interpreter's lock held.
class LongCall {
 public:
  LongCall();
  ~LongCall();
  LongCall(const LongCall&) = delete;
  LongCall& operator=(const LongCall&) = delete;

  /// Looks for signals, at most every twentieth of a second, without the lock held. Throws Stopped.
  void look_for_signals();
  /// Raises what was kept, if anything was.
  void raise_if_stopped() const;

  /// Keeps the exception that is being handled, for the innermost call of this thread, and throws
  /// Stopped; without such a call throws it again.
  [[noreturn]] static void stop_with_current_exception();

 private:
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
  std::exception_ptr raised_;
  LongCall* outer_;
};

/// The answer of `work`, which is called without the interpreter's lock and must not touch Python
/// but by `in_python`.
template <typename Work>
auto long_call(const Work& work) {
  using Answer = std::invoke_result_t<Work>;
  LongCall call;
  std::optional<Answer> answer;
  try {
    const pybind11::gil_scoped_release unlocked;
    const Interruptible scope([&call] { call.look_for_signals(); });
    answer.emplace(work());
  } catch (const Stopped&) {  // raised below
  } catch (...) {
    call.raise_if_stopped();  // what a step made of being stopped
    throw;
  }
  call.raise_if_stopped();
  return *std::move(answer);
}

/// Calls back into Python from within the work of a long call.
template <typename Call>
auto in_python(const Call& call) {
  const pybind11::gil_scoped_acquire locked;
  try {
    return call();
  } catch (...) {
    LongCall::stop_with_current_exception();
  }
}

}  // namespace palpation::python
