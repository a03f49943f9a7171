#include "io/vtp_bytes.h"

#include <vtkCallbackCommand.h>
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace palpation {
namespace {

// VTK's compressors count a block's bytes in an int.
constexpr std::uint64_t kLargestBlock = std::numeric_limits<std::int32_t>::max();

constexpr std::array<signed char, 256> base64_values() {
  std::array<signed char, 256> values{};
  values.fill(-1);
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<signed char>(i);
  return values;
}
constexpr std::array<signed char, 256> kBase64Values = base64_values();

/// The first `size` bytes that base64 text stands for; fewer where the text is too short or is
/// none.
std::string base64_bytes(std::string_view text, std::uint64_t size) {
  std::string bytes;
  bytes.reserve(std::min<std::uint64_t>(size, text.size()));
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = 0; i < text.size() && bytes.size() < size; ++i) {
    const int value = kBase64Values[static_cast<unsigned char>(text[i])];
    if (value < 0) break;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

vtkSmartPointer<vtkDataCompressor> compressor_of(VtpCompressor kind) {
  if (kind == VtpCompressor::ZLib) return vtkSmartPointer<vtkZLibDataCompressor>::New();
  if (kind == VtpCompressor::Lz4) return vtkSmartPointer<vtkLZ4DataCompressor>::New();
  return vtkSmartPointer<vtkLZMADataCompressor>::New();
}

}  // namespace

VtpBytes::VtpBytes(const MeshSource& source, const VtpLayout& layout, std::string_view text,
                   bool is_base64, bool is_whole)
    : source_(source), layout_(layout), text_(text), is_base64_(is_base64) {
  // An array without entries may have no text at all.
  if (is_whole && text.empty()) return;
  if (layout.compressor == VtpCompressor::None) {
    read_plain_header();
  } else {
    read_block_header();
  }
  if (is_whole && used_ != text_.size())
    fail(std::to_string(text_.size() - used_) + " characters more than the array's sizes announce");
}

std::string_view VtpBytes::unpacked() {
  if (size_ == 0) return {};
  if (layout_.compressor == VtpCompressor::None) {
    if (!is_base64_) return text_.substr(layout_.word, size_);
    storage_ = bytes_in(text_, layout_.word + size_);
    return std::string_view(storage_).substr(layout_.word);
  }
  const std::string_view body = text_.substr(header_written_);
  const std::uint64_t packed =
      std::accumulate(packed_sizes_.begin(), packed_sizes_.end(), std::uint64_t{0});
  if (is_base64_) {
    uncompress(bytes_in(body, packed));
  } else {
    uncompress(body);
  }
  return storage_;
}

/// The size in bytes, and the bytes right behind it.
void VtpBytes::read_plain_header() {
  size_ = words_of_header(0, leading_bytes(layout_.word));
  if (size_ > text_.size())
    fail("a size of " + std::to_string(size_) + " bytes does not fit into the " +
         std::to_string(text_.size()) + " that follow");
  take(layout_.word + size_);
}

/// How many blocks, their size unpacked, the size of the last if it is smaller, and the size of
/// each packed. In base64 the header is padded by itself.
void VtpBytes::read_block_header() {
  const std::string start = leading_bytes(3 * layout_.word);
  const std::uint64_t blocks = words_of_header(0, start), last = words_of_header(2, start);
  block_size_ = words_of_header(1, start);
  if (blocks > text_.size() / layout_.word || block_size_ > kLargestBlock || last > block_size_ ||
      (blocks == 0 && last > 0)) {
    fail("sizes that do not go together: " + std::to_string(blocks) + " blocks of " +
         std::to_string(block_size_) + " bytes, the last of " + std::to_string(last));
  }
  const std::uint64_t header_size = (3 + blocks) * layout_.word;
  const std::string header = leading_bytes(header_size);
  take(header_size);
  header_written_ = used_;
  std::uint64_t packed = 0;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    packed_sizes_.push_back(words_of_header(3 + i, header));
    if (packed_sizes_.back() > std::min<std::uint64_t>(kLargestBlock, text_.size() - packed)) {
      fail("a block of " + std::to_string(packed_sizes_.back()) + " bytes does not fit into the " +
           std::to_string(text_.size()) + " that follow");
    }
    packed += packed_sizes_.back();
  }
  take(packed);
  size_ = blocks == 0 ? 0 : last > 0 ? (blocks - 1) * block_size_ + last : blocks * block_size_;
}

std::uint64_t VtpBytes::words_of_header(std::uint64_t index, const std::string& header) const {
  const std::string_view bytes = std::string_view(header).substr(index * layout_.word);
  return layout_.word == 8 ? number_from<std::uint64_t>(bytes, layout_.order)
                           : number_from<std::uint32_t>(bytes, layout_.order);
}

std::string VtpBytes::leading_bytes(std::uint64_t size) const {
  if (written_size(size) > text_.size()) fail("the array ends inside its sizes");
  return bytes_in(text_, size);
}

/// How many characters bytes take that are written by themselves.
std::uint64_t VtpBytes::written_size(std::uint64_t bytes) const {
  return is_base64_ ? (bytes + 2) / 3 * 4 : bytes;
}

void VtpBytes::take(std::uint64_t bytes) {
  const std::uint64_t written = written_size(bytes);
  if (written > text_.size() - used_) {
    fail("sizes of " + std::to_string(bytes) + " bytes do not fit into the " +
         std::to_string(text_.size() - used_) + " characters that follow");
  }
  used_ += written;
}

std::string VtpBytes::bytes_in(std::string_view text, std::uint64_t size) const {
  if (!is_base64_) return std::string(text.substr(0, size));
  std::string bytes = base64_bytes(text.substr(0, written_size(size)), size);
  if (bytes.size() < size) fail("characters that are no base64");
  return bytes;
}

void VtpBytes::uncompress(std::string_view packed) {
  const vtkSmartPointer<vtkDataCompressor> compressor = compressor_of(layout_.compressor);
  // Whoever listens to an object's complaints keeps VTK from printing them.
  vtkNew<vtkCallbackCommand> listener;
  compressor->AddObserver(vtkCommand::ErrorEvent, listener);
  compressor->AddObserver(vtkCommand::WarningEvent, listener);
  storage_.resize(size_);
  auto* from = reinterpret_cast<const unsigned char*>(packed.data());
  auto* to = reinterpret_cast<unsigned char*>(storage_.data());
  std::uint64_t left = size_;
  for (std::size_t block = 0; block < packed_sizes_.size(); ++block) {
    const std::uint64_t size = std::min(left, block_size_);
    if (compressor->Uncompress(from, packed_sizes_[block], to, size) != size)
      fail("block " + std::to_string(block) + " of the compressed bytes is damaged");
    from += packed_sizes_[block];
    to += size;
    left -= size;
  }
}

void VtpBytes::fail(const std::string& what) const {
  source_.fail_at_byte(static_cast<std::size_t>(text_.data() - source_.bytes.data()), what);
}

}  // namespace palpation
