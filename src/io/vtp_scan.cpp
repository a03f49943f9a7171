#include "io/vtp_scan.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "io/byte_order.h"
#include "io/mesh_text.h"
#include "io/number_text.h"

namespace palpation {
namespace {

/// zlib, the strongest of VTK's compressors, makes at most 1032 bytes of one: more than that cannot be in a file.
constexpr std::uint64_t kMostBytesPerByte = 1032;
constexpr std::string_view kBlank = " \t\r\n";

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// The bytes that are XML: all of them, or those before the data in an AppendedData element.
std::size_t xml_size(std::string_view bytes) {
  const std::size_t appended = bytes.find("<AppendedData");
  return appended == std::string_view::npos ? bytes.size() : std::min(bytes.find('>', appended), bytes.size() - 1) + 1;
}

/// Comments become blanks, so that positions stay; whatever else hides text from a simple scan is refused.
std::string without_comments(const MeshSource& source) {
  std::string bytes(source.bytes);
  for (std::size_t start = bytes.find("<!--"); start < xml_size(bytes); start = bytes.find("<!--")) {
    const std::size_t end = bytes.find("-->", start + 4);
    if (end == std::string::npos) source.fail_at_byte(start, "a comment without end");
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(start), bytes.begin() + static_cast<std::ptrdiff_t>(end + 3), ' ');
  }
  const std::string_view xml = std::string_view(bytes).substr(0, xml_size(bytes));
  const std::size_t hidden = std::min(xml.find("<!"), xml.find('&'));
  if (hidden < xml.size()) source.fail_at_byte(hidden, "entities, CDATA and document types are not read in VTP files");
  return bytes;
}

/// One start tag: "<Name attribute="value" ...>".
struct Tag {
  std::string_view text;
  std::size_t position;  ///< of its '<'
  std::size_t end;       ///< behind its '>'

  std::optional<std::string_view> attribute(std::string_view name) const {
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
      if (is_name_character(text[at - 1])) continue;
      std::size_t next = text.find_first_not_of(kBlank, at + name.size());
      if (next == std::string_view::npos || text[next] != '=') continue;
      next = text.find_first_not_of(kBlank, next + 1);
      if (next == std::string_view::npos || (text[next] != '"' && text[next] != '\'')) continue;
      const std::size_t close = text.find(text[next], next + 1);
      if (close != std::string_view::npos) return trimmed(text.substr(next + 1, close - next - 1));
    }
    return std::nullopt;
  }
};

/// Walks over the start tags in front of `end`.
std::optional<Tag> next_tag(std::string_view bytes, std::size_t from, std::size_t end) {
  const std::size_t start = bytes.find('<', from);
  if (start >= end) return std::nullopt;
  const std::size_t close = bytes.find('>', start);
  if (close == std::string_view::npos) return std::nullopt;
  return Tag{bytes.substr(start, close - start), start, close + 1};
}

int base64_value(char c) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t value = kDigits.find(c);
  return value == std::string_view::npos ? -1 : static_cast<int>(value);
}

/// The first bytes that base64 text stands for; fewer where the text ends or is none.
std::string base64_prefix(std::string_view text, std::size_t size) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = 0; i < text.size() && bytes.size() < size; ++i) {
    const int value = base64_value(text[i]);
    if (value < 0) break;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

/// How the numbers of the file's arrays are laid out.
struct Layout {
  ByteOrder order = ByteOrder::Little;
  std::size_t word = 4;  ///< bytes of a size in a header
  bool compressed = false;
  bool raw = false;                     ///< appended data as bytes, not as base64
  std::optional<std::size_t> appended;  ///< where offset 0 is
};

class Scan {
 public:
  Scan(const MeshSource& source, std::string_view bytes) : source_(source), bytes_(bytes), xml_size_(xml_size(bytes)) {}

  void check() {
    find_layout();
    for (std::optional<Tag> tag = next_tag(bytes_, 0, xml_size_); tag; tag = next_tag(bytes_, tag->end, xml_size_)) {
      check_counts(*tag);
      if (tag->text.starts_with("<DataArray") || tag->text.starts_with("<Array")) check_array(*tag);
    }
    const std::uint64_t most = limit();
    if (most_components_ > 0 && most_entries_ > most / most_components_) {
      source_.fail("counts and components in the file ask for more numbers than its bytes can hold");
    }
  }

 private:
  void find_layout() {
    for (std::optional<Tag> tag = next_tag(bytes_, 0, xml_size_); tag; tag = next_tag(bytes_, tag->end, xml_size_)) {
      if (tag->text.starts_with("<VTKFile")) {
        if (tag->attribute("byte_order") == "BigEndian") layout_.order = ByteOrder::Big;
        if (tag->attribute("header_type") == "UInt64") layout_.word = 8;
        layout_.compressed = tag->attribute("compressor").has_value();
      } else if (tag->text.starts_with("<AppendedData")) {
        layout_.raw = tag->attribute("encoding") != "base64";
        const std::size_t mark = bytes_.find_first_not_of(kBlank, tag->end);
        if (mark == std::string_view::npos || bytes_[mark] != '_')
          source_.fail_at_byte(tag->position, "appended data must begin with \"_\"");
        layout_.appended = mark + 1;
      }
    }
  }

  std::uint64_t limit() const { return bytes_.size() * (layout_.compressed ? kMostBytesPerByte : 1); }

  void check_counts(const Tag& tag) {
    for (const char* name : {"NumberOfPoints", "NumberOfPolys", "NumberOfStrips", "NumberOfLines", "NumberOfVerts", "NumberOfTuples"}) {
      if (const auto count = count_of(tag, name, limit())) most_entries_ = std::max(most_entries_, *count);
    }
    if (const auto count = count_of(tag, "NumberOfComponents", 4096)) most_components_ = std::max(most_components_, *count);
  }

  std::optional<std::uint64_t> count_of(const Tag& tag, std::string_view name, std::uint64_t most) const {
    const std::optional<std::string_view> text = tag.attribute(name);
    if (!text) return std::nullopt;
    const std::optional<std::int64_t> value = parse_integer(*text);
    if (value && *value >= 0 && static_cast<std::uint64_t>(*value) <= most) return static_cast<std::uint64_t>(*value);
    source_.fail_at_byte(tag.position, std::string(name) + " = " + in_quotes(*text) + " must be a whole number from 0 to " +
                                           std::to_string(most) + " in a file of this size");
  }

  void check_array(const Tag& tag) const {
    const std::optional<std::string_view> format = tag.attribute("format");
    // VTK goes by the offset, whatever the format says.
    const bool known = format == "ascii" || format == "binary" || format == "appended";
    if (!known || tag.attribute("offset").has_value() != (format == "appended")) {
      source_.fail_at_byte(tag.position, "an array's format must be ascii, binary, or appended with an offset");
    }
    if (format == "appended") {
      const std::optional<std::uint64_t> offset = count_of(tag, "offset", bytes_.size());
      if (!offset) source_.fail_at_byte(tag.position, "an appended array without offset");
      if (!layout_.appended) source_.fail_at_byte(tag.position, "the file ends before its appended data");
      const std::size_t start = *layout_.appended + static_cast<std::size_t>(*offset);
      if (start > bytes_.size())
        source_.fail_at_byte(tag.position, "offset " + std::to_string(*offset) + " points behind the end of the file");
      check_blocks(start, bytes_.substr(start), layout_.raw);
    } else if (format == "binary") {
      const std::size_t start = std::min(bytes_.find_first_not_of(kBlank, tag.end), bytes_.size());
      const std::string_view text = bytes_.substr(start, bytes_.substr(start).find('<'));
      // An array of no entries may have no text at all.
      if (!text.empty()) check_blocks(start, text, /*raw=*/false);
    }
  }

  /// The header of an array's data, and that what it announces is there.
  void check_blocks(std::size_t position, std::string_view text, bool raw) const {
    const std::uint64_t available = text.size();
    const std::uint64_t first = word(position, text, raw, 0);
    if (!layout_.compressed) {
      if (first > available) fail(position, first, available);
      return;
    }
    const std::uint64_t blocks = first;
    if (blocks > available / layout_.word) fail(position, blocks, available);
    const std::uint64_t block_size = word(position, text, raw, 1), last_size = word(position, text, raw, 2);
    if (last_size > block_size || block_size > std::numeric_limits<std::uint32_t>::max()) fail(position, block_size, available);
    // Without blocks VTK would take the size of the last one for that of block -1.
    if (blocks == 0 && last_size > 0) fail(position, last_size, available);
    if (blocks == 0) return;
    const std::string header = header_bytes(text, raw, 3 + static_cast<std::size_t>(blocks));
    std::uint64_t compressed = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::uint64_t size = word_of(position, header, 3 + i);
      if (size > available - std::min(available, compressed)) fail(position, size, available);
      compressed += size;
    }
    // The last block may be the only one, and small beside the size that all others would have.
    const std::uint64_t whole = (last_size > 0 ? blocks - 1 : blocks) * block_size + last_size;
    if (whole > (compressed + 1) * kMostBytesPerByte) fail(position, whole, available);
  }

  [[noreturn]] void fail(std::size_t position, std::uint64_t size, std::uint64_t available) const {
    source_.fail_at_byte(position, "a block size or count of " + std::to_string(size) + " does not go with the " +
                                       std::to_string(available) + " bytes that follow");
  }

  std::string header_bytes(std::string_view text, bool raw, std::size_t words) const {
    const std::size_t size = words * layout_.word;
    return raw ? std::string(text.substr(0, size)) : base64_prefix(text, size);
  }

  std::uint64_t word(std::size_t position, std::string_view text, bool raw, std::size_t index) const {
    return word_of(position, header_bytes(text, raw, index + 1), index);
  }

  std::uint64_t word_of(std::size_t position, const std::string& header, std::size_t index) const {
    if (header.size() < (index + 1) * layout_.word)
      source_.fail_at_byte(position, "the file ends, or is no base64, inside the sizes of an array");
    const std::string_view bytes = std::string_view(header).substr(index * layout_.word);
    return layout_.word == 8 ? number_from<std::uint64_t>(bytes, layout_.order) : number_from<std::uint32_t>(bytes, layout_.order);
  }

  const MeshSource& source_;
  std::string_view bytes_;
  std::size_t xml_size_;
  Layout layout_;
  std::uint64_t most_entries_ = 0, most_components_ = 0;
};

}  // namespace

std::string vetted_vtp(const MeshSource& source) {
  std::string bytes = without_comments(source);
  Scan(source, bytes).check();
  return bytes;
}

}  // namespace palpation
