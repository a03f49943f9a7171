#include "python/long_call.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};

thread_local LongCall* innermost = nullptr;

}  // namespace

LongCall::LongCall() : outer_(innermost) { innermost = this; }

LongCall::~LongCall() { innermost = outer_; }

void LongCall::look_for_signals() {
  if (raised_) throw Stopped();  // a step that went on nevertheless
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ < kBetweenLooks) return;
  last_look_ = now;
  in_python([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return true;
  });
}

void LongCall::raise_if_stopped() const {
  if (raised_) std::rethrow_exception(raised_);
}

void LongCall::stop_with_current_exception() {
  if (innermost == nullptr) throw;
  if (!innermost->raised_) innermost->raised_ = std::current_exception();
  throw Stopped();
}

}  // namespace palpation::python
