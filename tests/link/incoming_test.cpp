// What clients say, cut anywhere.
#include "link/incoming.h"

#include <gtest/gtest.h>

#include "palpation/base/random.h"

namespace palpation::link {
namespace {

/// A header of the protocol: version, type, device, time, size of the body, CRC.
std::string said(const std::string& type, const std::string& device, std::uint64_t body_bytes,
                 int version = 1) {
  std::string bytes(58, '\0');
  bytes[1] = static_cast<char>(version);
  bytes.replace(2, type.size(), type);
  bytes.replace(14, device.size(), device);
  for (int i = 0; i < 8; ++i) bytes[49 - i] = static_cast<char>(body_bytes >> (8 * i) & 0xff);
  return bytes;
}

std::string told(const std::vector<Heard>& heard) {
  std::string words;
  for (const Heard& one : heard) words += one.type + " " + one.device + ";";
  return words;
}

TEST(Incoming, BodiesArePassedOverWhateverTheyHold) {
  const std::string bytes = said("GET_POINT", "touches", 70) + said("GET_LIES", "", 12) +
                            std::string(12, 'x') + said("GET_STATUS", "", 0);
  Incoming incoming;
  EXPECT_EQ(told(incoming.take(bytes)), "GET_POINT touches;GET_STATUS ;");
  EXPECT_FALSE(incoming.is_garbage());
}

TEST(Incoming, BytesThatComeOneByOneSayTheSame) {
  const std::string bytes = said("GET_POINT", "twenty bytes of name", 3, 3) + "abc" +
                            said("STT_TDATA", "tracker", 0, 2) +
                            "no message, but long enough to "
                            "be taken for a header of one";
  Incoming at_once, one_by_one;
  const std::string whole = told(at_once.take(bytes));
  std::string pieces;
  for (const char byte : bytes) pieces += told(one_by_one.take({&byte, 1}));
  EXPECT_EQ(whole, "GET_POINT twenty bytes of name;STT_TDATA tracker;");
  EXPECT_EQ(pieces, whole);
  EXPECT_TRUE(at_once.is_garbage());
  EXPECT_TRUE(one_by_one.is_garbage());
}

TEST(Incoming, WhatCannotBeAHeaderIsGarbageAndSoIsAllThatFollows) {
  for (const std::string& bytes :
       {said("GET_POINT", "", 0, 0), said("GET_POINT", "", 0, 4), said("", "", 0),
        said("GET POINT", "", 0), said("GET_POINT", "", ~std::uint64_t{0})}) {
    Incoming incoming;
    EXPECT_EQ(told(incoming.take(bytes + said("GET_STATUS", "", 0))), "");
    EXPECT_TRUE(incoming.is_garbage());
    EXPECT_EQ(told(incoming.take(said("GET_STATUS", "", 0))), "");
  }
}

TEST(Incoming, NoBytesStopIt) {
  Random random(7);
  for (int attempt = 0; attempt < 2000; ++attempt) {
    Incoming incoming;
    std::string bytes = said("GET_STATUS", "x", random.uniform() < 0.5 ? 0 : 40);
    for (int i = 0; i < 200; ++i) bytes += static_cast<char>(random.below(256));
    for (int i = 0; i < attempt % 4; ++i)
      bytes[static_cast<std::size_t>(random.below(58))] = static_cast<char>(random.below(256));
    const auto cut = static_cast<std::size_t>(static_cast<double>(bytes.size()) * random.uniform());
    std::size_t heard = incoming.take(std::string_view(bytes).substr(0, cut)).size();
    heard += incoming.take(std::string_view(bytes).substr(cut)).size();
    EXPECT_LE(heard, bytes.size() / 58);
  }
}

}  // namespace
}  // namespace palpation::link
