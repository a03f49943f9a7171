#include "palpation/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/base/interruption.h"

namespace palpation {
namespace {

std::atomic<int> allowed_threads{
    static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))};
thread_local bool inside_range = false;

}  // namespace

void set_thread_count(int count) {
  require(count >= 1, "set_thread_count", std::to_string(count), "must be at least 1");
  allowed_threads = count;
}

int thread_count() { return allowed_threads; }

void for_ranges(int count, int grain, const std::function<void(int, int)>& work) {
  check_interruption();
  const int pieces = (count + grain - 1) / grain;
  const int threads = inside_range ? 1 : std::min(thread_count(), pieces);
  if (threads <= 1) {
    if (count > 0) work(0, count);
    return;
  }
  std::atomic<int> next_piece{0};
  std::exception_ptr first_failure;
  std::mutex failure_guard;
  const auto take_pieces = [&] {
    inside_range = true;
    for (int piece = next_piece++; piece < pieces; piece = next_piece++) {
      try {
        check_interruption();
        work(piece * grain, std::min(count, (piece + 1) * grain));
      } catch (...) {
        const std::lock_guard lock(failure_guard);
        if (!first_failure) first_failure = std::current_exception();
        next_piece = pieces;
      }
    }
    inside_range = false;
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(take_pieces);
    take_pieces();
  }
  if (first_failure) std::rethrow_exception(first_failure);
}

}  // namespace palpation
