// What a slow client is still to be sent.
#include "link/outbox.h"

#include <gtest/gtest.h>

namespace palpation::link {
namespace {

SharedBytes bytes(const std::string& text) { return std::make_shared<const std::string>(text); }

/// All of it, `step` bytes at a time.
std::string drained(Outbox& outbox, std::size_t step) {
  std::string text;
  while (!outbox.is_empty()) {
    const std::string_view next = outbox.next().substr(0, step);
    text += next;
    outbox.sent(next.size());
  }
  return text;
}

TEST(Outbox, ANewerMessageTakesThePlaceOfOneThatHasNotBegun) {
  Outbox outbox;
  outbox.put("tissue", bytes("[tissue 1]"));
  outbox.put("outline", bytes("[outline 1]"));
  outbox.put("tissue", bytes("[tissue 2]"));
  EXPECT_EQ(drained(outbox, 3), "[tissue 2][outline 1]");
}

TEST(Outbox, AMessageThatHasBegunIsSentToItsEnd) {
  Outbox outbox;
  outbox.put("tissue", bytes("[tissue 1]"));
  EXPECT_EQ(outbox.next(), "[tissue 1]");
  outbox.sent(4);
  outbox.put("tissue", bytes("[tissue 2]"));
  outbox.put("tissue", bytes("[tissue 3]"));
  EXPECT_EQ(drained(outbox, 100), "sue 1][tissue 3]");
}

TEST(Outbox, ItHoldsNoMoreHoweverOftenAMessageChanges) {
  Outbox outbox;
  const SharedBytes first = bytes("a"), last = bytes("z");
  outbox.put("device", first);
  for (int i = 0; i < 1000; ++i) outbox.put("device", i == 999 ? last : bytes("m"));
  EXPECT_EQ(first.use_count(), 1);
  EXPECT_EQ(drained(outbox, 1), "z");
  EXPECT_EQ(last.use_count(), 1);
}

TEST(Outbox, AMessageWithoutBytesIsNoMessage) {
  Outbox outbox;
  outbox.put("nothing", bytes(""));
  outbox.put("device", bytes("a"));
  EXPECT_EQ(drained(outbox, 1), "a");
}

}  // namespace
}  // namespace palpation::link
