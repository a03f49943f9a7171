/// Many doubles on a border of cache lines, without a value at first; large arrays ask the system for large pages, which are touched
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
  void operator()(double* values) const { std::free(values); }
};
using AlignedDoubles = std::unique_ptr<double[], FreeAligned>;

inline AlignedDoubles aligned_doubles(std::size_t count) {
  constexpr std::size_t kLine = 64, kLargePage = std::size_t{2} << 20;
  const std::size_t bytes = count * sizeof(double), border = bytes >= kLargePage ? kLargePage : kLine;
  void* memory = std::aligned_alloc(border, (bytes + kLine - 1) / kLine * kLine);
  if (!memory && bytes > 0) throw std::bad_alloc();
#ifdef __linux__
  if (border == kLargePage) madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return AlignedDoubles(static_cast<double*>(memory));
}

}  // namespace palpation
