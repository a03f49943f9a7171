#include "palpation/base/interruption.h"

#include <utility>

namespace palpation {
namespace {

thread_local const Interruptible* innermost = nullptr;

}  // namespace

Interruptible::Interruptible(std::function<void()> check)
    : check_(std::move(check)), outer_(innermost) {
  innermost = this;
}

Interruptible::~Interruptible() { innermost = outer_; }

void check_interruption() {
  if (innermost != nullptr) innermost->check_();
}

}  // namespace palpation
