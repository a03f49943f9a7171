/// Many numbers on a border of cache lines, without a value at first.
///
/// Large arrays ask the system for large pages, which are touched sooner and found faster. A belief
/// that is built anew is as large as the one before it: what was freed last is kept, up to 512 MiB
/// in all, and handed out again, since the system clears pages at the rate at which rows are
/// computed.
#pragma once

#include <cstddef>
#include <memory>

namespace palpation {

/// Throws std::bad_alloc. The array may have been used before.
void* take_aligned(std::size_t bytes);
void give_back_aligned(void* memory, std::size_t bytes);

struct GiveBack {
  std::size_t bytes = 0;
  void operator()(void* memory) const { give_back_aligned(memory, bytes); }
};
template <typename Value>
using Aligned = std::unique_ptr<Value[], GiveBack>;
using AlignedDoubles = Aligned<double>;

template <typename Value>
Aligned<Value> aligned(std::size_t count) {
  const std::size_t bytes = count * sizeof(Value);
  return Aligned<Value>(static_cast<Value*>(take_aligned(bytes)), GiveBack{bytes});
}

inline AlignedDoubles aligned_doubles(std::size_t count) { return aligned<double>(count); }

}  // namespace palpation
