/// What every fuzz target has in common. A target is one function of a file's bytes: whatever they
/// are, it returns, or it stops the program because a promise was broken. Errors that the library
/// throws on purpose are kept promises.
///
/// Built by clang with libFuzzer (preset "fuzz") a target searches by coverage; in every other
/// build it replays files and mutates them without guidance (replay.cpp), so that each find stays a
/// test on any machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "palpation/geometry/surface.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace palpation::fuzz {

/// Bytes that the library's readers find under a path, without touching a disk.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* bytes, std::size_t size);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const;

 private:
  int descriptor_;
};

/// Stops the program with the claim that does not hold.
void expect(bool holds, const char* claim);

/// Numbers from bytes, for targets whose input is no file. At the end all are zero.
class Numbers {
 public:
  Numbers(const std::uint8_t* bytes, std::size_t size) : rest_(bytes, size) {}
  bool any_left() const { return !rest_.empty(); }
  std::uint8_t byte();
  /// Any finite double: whole numbers, neighbours of them and raw bits, so that degenerate cases
  /// are as likely as wild ones.
  double real();

 private:
  std::span<const std::uint8_t> rest_;
};

/// A flat sheet of 25 x 25 mm, 6 x 6 vertices.
const Surface& sheet();

/// Small surfaces of every kind: flat, with a hole, curved, closed, in two pieces.
std::span<const Surface> surfaces();

}  // namespace palpation::fuzz
