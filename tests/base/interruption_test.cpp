#include "palpation/base/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "palpation/base/parallel.h"

namespace palpation {
namespace {

struct Stop {};

/// Work in pieces, on several threads; how many pieces were done.
int pieces_done(const std::function<void(int)>& piece) {
  std::atomic<int> done{0};
  for_ranges(1000, 1, [&](int first, int) {
    piece(first);
    ++done;
  });
  return done;
}

TEST(Interruptible, EndsWorkInPiecesWithWhatItThrows) {
  set_thread_count(2);
  bool is_asked = false;
  const Interruptible scope([&] {
    if (is_asked) throw Stop();
  });
  EXPECT_EQ(pieces_done([](int) {}), 1000);
  is_asked = true;
  EXPECT_THROW(pieces_done([](int) {}), Stop);
}

TEST(Interruptible, EndsWorkThatHasBegunAndTheNextIsWhole) {
  set_thread_count(2);
  const std::thread::id mine = std::this_thread::get_id();
  std::atomic<bool> is_stopped{false};
  {
    bool is_asked = false;
    const Interruptible scope([&] {
      if (!is_asked) return;
      is_stopped = true;
      is_stopped.notify_all();
      throw Stop();
    });
    EXPECT_THROW(pieces_done([&](int) {
                   if (std::this_thread::get_id() == mine)
                     is_asked = true;
                   else
                     is_stopped.wait(false);  // or the other thread might do all the pieces alone
                 }),
                 Stop);
  }
  EXPECT_EQ(pieces_done([](int) {}), 1000);
}

TEST(Interruptible, IsCalledInItsOwnThreadAlone) {
  set_thread_count(3);
  const std::thread::id mine = std::this_thread::get_id();
  int calls = 0;
  const Interruptible scope([&] {
    EXPECT_EQ(std::this_thread::get_id(), mine);
    ++calls;
  });
  pieces_done([](int) {});
  EXPECT_GT(calls, 0);
  std::thread([] { check_interruption(); }).join();  // which has none
}

TEST(Interruptible, TheInnermostCountsUntilItIsGone) {
  int outer = 0, inner = 0;
  const Interruptible around([&] { ++outer; });
  {
    const Interruptible within([&] { ++inner; });
    check_interruption();
  }
  check_interruption();
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 1);
}

TEST(CheckInterruption, DoesNothingWhereNobodyAsks) { EXPECT_NO_THROW(check_interruption()); }

}  // namespace
}  // namespace palpation
