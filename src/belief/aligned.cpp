#include "belief/aligned.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

#include "palpation/belief/memory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace palpation {
namespace {

constexpr std::size_t kLine = 64, kLargePage = std::size_t{2} << 20;
constexpr std::size_t kWorthKeeping = std::size_t{256} << 10;
constexpr std::size_t kMostKept = std::size_t{512} << 20;

struct Block {
  void* memory;
  std::size_t size;
};

/// The blocks that are free, the last freed last.
struct Kept {
  std::mutex mutex;
  std::vector<Block> blocks;
  std::size_t bytes = 0;

  Kept() { blocks.reserve(kMostKept / kWorthKeeping + 1); }  // who gives back must not fail
  void forget(std::vector<Block>::iterator block) {
    bytes -= block->size;
    blocks.erase(block);
  }
};

Kept& kept() {
  static Kept& blocks = *new Kept;  // outlives every array
  return blocks;
}

bool may_be_kept(std::size_t bytes) { return bytes >= kWorthKeeping && bytes <= kMostKept; }

/// What may be kept has room to grow to the next power of two, so that an array finds the room of a
/// smaller one before it. What is never touched costs nothing.
std::size_t size_of(std::size_t bytes) {
  return may_be_kept(bytes) ? std::bit_ceil(bytes) : std::max(bytes, kLine);
}

void want_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  if (bytes >= kLargePage)
    madvise(memory, bytes / kLargePage * kLargePage,
            MADV_HUGEPAGE);  // no more of them than are filled
#endif
}

}  // namespace

void* take_aligned(std::size_t bytes) {
  const std::size_t size = size_of(bytes);
  if (may_be_kept(bytes)) {
    const std::lock_guard lock(kept().mutex);
    std::vector<Block>& blocks = kept().blocks;
    const auto last = std::find_if(blocks.rbegin(), blocks.rend(),
                                   [&](const Block& block) { return block.size == size; });
    if (last != blocks.rend()) {
      void* memory = last->memory;
      kept().forget(std::prev(last.base()));
      want_large_pages(memory, bytes);
      return memory;
    }
  }
  void* memory = nullptr;
  if (posix_memalign(&memory, size >= kLargePage ? kLargePage : kLine, size) != 0)
    throw std::bad_alloc();
  want_large_pages(memory, bytes);
  return memory;
}

void give_back_aligned(void* memory, std::size_t bytes) {
  if (!may_be_kept(bytes)) return std::free(memory);
  const std::size_t size = size_of(bytes);
  const std::lock_guard lock(kept().mutex);
  kept().blocks.push_back({memory, size});
  kept().bytes += size;
  while (kept().bytes > kMostKept) {
    std::free(kept().blocks.front().memory);
    kept().forget(kept().blocks.begin());
  }
}

void release_memory() {
  const std::lock_guard lock(kept().mutex);
  for (const Block& block : kept().blocks) std::free(block.memory);
  kept().blocks.clear();
  kept().bytes = 0;
}

}  // namespace palpation
