/// Many numbers on a border of cache lines, without a value at first; large arrays ask the system for large pages, which are touched
/// sooner and found faster.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace palpation {

struct FreeAligned {
  void operator()(void* values) const { std::free(values); }
};
template <typename Value>
using Aligned = std::unique_ptr<Value[], FreeAligned>;
using AlignedDoubles = Aligned<double>;

template <typename Value>
Aligned<Value> aligned(std::size_t count) {
  constexpr std::size_t kLine = 64, kLargePage = std::size_t{2} << 20;
  const std::size_t bytes = count * sizeof(Value), border = bytes >= kLargePage ? kLargePage : kLine;
  // aligned_alloc would have the size rounded up to the border: that many large pages are not needed.
  void* memory = nullptr;
  if (posix_memalign(&memory, border, bytes > 0 ? bytes : kLine) != 0) throw std::bad_alloc();
#ifdef __linux__
  if (border == kLargePage) madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return Aligned<Value>(static_cast<Value*>(memory));
}

inline AlignedDoubles aligned_doubles(std::size_t count) { return aligned<double>(count); }

}  // namespace palpation
