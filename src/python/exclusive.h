/// An object that changes, in the hands of one caller at a time: the library's values are not to be
/// read while they change, and the interpreter's lock is released meanwhile.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpation::python {

template <typename Value>
class Exclusive {
 public:
  explicit Exclusive(Value value) : value_(std::move(value)) {}

  class Held {
   public:
    Held(Value& value, std::atomic_flag& taken) : value_(value), taken_(taken) {}
    ~Held() { taken_.clear(); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    Value& operator*() const { return value_; }
    Value* operator->() const { return &value_; }

   private:
    Value& value_;
    std::atomic_flag& taken_;
  };

  /// Never waits, which could be for ever: throws std::runtime_error (RuntimeError) while another
  /// call holds it, be it another thread's or the one that called the caller's function.
  Held take(const std::string& name) {
    if (taken_.test_and_set())
      throw std::runtime_error(name + ": is in use by another call: take turns");
    return Held(value_, taken_);
  }

 private:
  Value value_;
  std::atomic_flag taken_{};
};

}  // namespace palpation::python
