/// The bytes of one array of a VTP file: in base64 or as they are, compressed in blocks or not,
/// behind a header that tells their size.
///
/// The header is reconciled with the bytes there are before anything is allocated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/byte_order.h"
#include "io/mesh_source.h"

namespace palpation {

enum class VtpCompressor { None, ZLib, Lz4, Lzma };

/// What holds for all arrays of a file.
struct VtpLayout {
  ByteOrder order = ByteOrder::Little;
  std::size_t word = 4;  ///< bytes of a number in a header
  VtpCompressor compressor = VtpCompressor::None;
  std::optional<std::string_view> appended;  ///< what offsets count from
  bool appended_is_base64 = false;
};

class VtpBytes {
 public:
  /// `text` begins with the header. Throws IoError naming the byte unless it holds what the header
  /// announces, and if `is_whole` nothing else.
  VtpBytes(const MeshSource& source, const VtpLayout& layout, std::string_view text, bool is_base64,
           bool is_whole);

  /// How many bytes there are once they are unpacked.
  std::uint64_t size() const { return size_; }
  /// The bytes; the view holds as long as this object. Throws IoError if they are not sound.
  std::string_view unpacked();

 private:
  void read_plain_header();
  void read_block_header();
  std::uint64_t words_of_header(std::uint64_t index, const std::string& header) const;
  std::string leading_bytes(std::uint64_t size) const;
  std::uint64_t written_size(std::uint64_t bytes) const;
  void take(std::uint64_t bytes);
  std::string bytes_in(std::string_view text, std::uint64_t size) const;
  void uncompress(std::string_view packed);
  [[noreturn]] void fail(const std::string& what) const;

  const MeshSource& source_;
  const VtpLayout& layout_;
  std::string_view text_;
  bool is_base64_;
  std::uint64_t used_ = 0;            ///< characters of the text that are accounted for
  std::uint64_t size_ = 0;            ///< unpacked
  std::uint64_t header_written_ = 0;  ///< characters of the header, if it stands by itself
  std::uint64_t block_size_ = 0;
  std::vector<std::uint64_t> packed_sizes_;
  std::string storage_;
};

}  // namespace palpation
