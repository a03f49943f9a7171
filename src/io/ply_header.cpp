#include "io/ply_header.h"

#include <utility>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr std::size_t kMostElements = 64;
constexpr std::size_t kMostProperties = 256;
constexpr std::size_t kLongestHeaderLine = 4096;

std::optional<PlyScalar> scalar_of(std::string_view name) {
  if (name == "char" || name == "int8") return PlyScalar::Int8;
  if (name == "uchar" || name == "uint8") return PlyScalar::UInt8;
  if (name == "short" || name == "int16") return PlyScalar::Int16;
  if (name == "ushort" || name == "uint16") return PlyScalar::UInt16;
  if (name == "int" || name == "int32") return PlyScalar::Int32;
  if (name == "uint" || name == "uint32") return PlyScalar::UInt32;
  if (name == "float" || name == "float32") return PlyScalar::Float32;
  if (name == "double" || name == "float64") return PlyScalar::Float64;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const MeshSource& source) : source_(source) {}

  PlyHeader read() {
    next_line();  // "ply", by which the format was recognized
    do {
      next_line();
      take_line();
    } while (!done_);
    if (!has_format_) fail("the header has no format line");
    header_.size = position_;
    header_.lines = line_;
    return std::move(header_);
  }

 private:
  /// PlyHeader lines all end like the first: after CR alone, a line feed may be the first byte of
  /// binary data.
  void next_line() {
    const std::size_t end =
        source_.bytes.find_first_of(line_ == 0 ? "\r\n" : line_end_.substr(0, 1), position_);
    if (line_ == 0 && end != std::string_view::npos)
      line_end_ = source_.bytes.substr(end, source_.bytes.substr(end, 2) == "\r\n" ? 2 : 1);
    ++line_;
    if (end == std::string_view::npos || source_.bytes.substr(end, line_end_.size()) != line_end_) {
      fail("the header ends without a line \"end_header\", or its line ends are mixed");
    }
    if (end - position_ > kLongestHeaderLine) fail("a header line has more than 4096 bytes");
    const std::string_view line = source_.bytes.substr(position_, end - position_);
    if (line.find('\0') != std::string_view::npos) fail("a NUL byte in the header");
    if (line.find_first_of("\r\n") != std::string_view::npos)
      fail("the header's line ends are mixed");
    split_words(line, words_);
    position_ = end + line_end_.size();
  }

  void take_line() {
    if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") return;
    if (words_[0] == "format") {
      take_format();
    } else if (words_[0] == "element") {
      take_element();
    } else if (words_[0] == "property") {
      take_property();
    } else if (words_[0] == "end_header" && words_.size() == 1) {
      done_ = true;
    } else {
      fail(in_quotes(words_[0]) + " is no statement of a PLY header");
    }
  }

  void take_format() {
    if (words_.size() != 3 || words_[2] != "1.0" || has_format_)
      fail("one line \"format <encoding> 1.0\" is expected");
    has_format_ = true;
    if (words_[1] == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (words_[1] == "binary_little_endian") {
      header_.encoding = PlyEncoding::Little;
    } else if (words_[1] == "binary_big_endian") {
      header_.encoding = PlyEncoding::Big;
    } else {
      fail(in_quotes(words_[1]) +
           " is no encoding: ascii, binary_little_endian or binary_big_endian");
    }
  }

  void take_element() {
    if (words_.size() != 3) fail("\"element <name> <count>\" is expected");
    const std::optional<std::int64_t> count = parse_integer(words_[2]);
    if (!count || *count < 0) fail(in_quotes(words_[2]) + " is not a count");
    if (header_.elements.size() == kMostElements) fail("more than 64 elements");
    const std::string name(words_[1]);
    for (const PlyElement& element : header_.elements) {
      if (element.name == name) fail("element " + in_quotes(name) + " appears twice");
    }
    // They would be faces, left out without a word.
    if (name == "tristrips" && *count > 0)
      fail("strips of triangles are not read: write them as faces");
    header_.elements.push_back({name, *count, {}, line_});
  }

  void take_property() {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyElement& element = header_.elements.back();
    if (element.properties.size() == kMostProperties)
      fail("more than 256 properties of element " + in_quotes(element.name));
    PlyProperty property;
    if (words_.size() == 5 && words_[1] == "list") {
      property = {std::string(words_[4]), type_of(words_[3]), type_of(words_[2])};
      if (is_real(*property.count_type))
        fail("a list's count must be a whole number, not " + in_quotes(words_[2]));
    } else if (words_.size() == 3) {
      property = {std::string(words_[2]), type_of(words_[1]), std::nullopt};
    } else {
      fail("\"property <type> <name>\" or \"property list <type> <type> <name>\" is expected");
    }
    for (const PlyProperty& other : element.properties) {
      if (other.name == property.name)
        fail("property " + in_quotes(property.name) + " of element " + in_quotes(element.name) +
             " appears twice");
    }
    element.properties.push_back(property);
  }

  PlyScalar type_of(std::string_view name) const {
    const std::optional<PlyScalar> type = scalar_of(name);
    if (!type) fail(in_quotes(name) + " is no type");
    return *type;
  }

  [[noreturn]] void fail(const std::string& what) const { source_.fail_at_line(line_, what); }

  const MeshSource& source_;
  PlyHeader header_;
  std::vector<std::string_view> words_;
  std::string_view line_end_ = "\n";
  std::size_t position_ = 0;
  std::int64_t line_ = 0;
  bool has_format_ = false;
  bool done_ = false;
};

}  // namespace

std::size_t size_of(PlyScalar type) {
  switch (type) {
    case PlyScalar::Int8:
    case PlyScalar::UInt8:
      return 1;
    case PlyScalar::Int16:
    case PlyScalar::UInt16:
      return 2;
    case PlyScalar::Int32:
    case PlyScalar::UInt32:
    case PlyScalar::Float32:
      return 4;
    case PlyScalar::Float64:
      return 8;
  }
  return 8;
}

bool is_real(PlyScalar type) { return type == PlyScalar::Float32 || type == PlyScalar::Float64; }

bool holds(PlyScalar type, std::int64_t value) {
  switch (type) {
    case PlyScalar::Int8:
      return std::in_range<std::int8_t>(value);
    case PlyScalar::UInt8:
      return std::in_range<std::uint8_t>(value);
    case PlyScalar::Int16:
      return std::in_range<std::int16_t>(value);
    case PlyScalar::UInt16:
      return std::in_range<std::uint16_t>(value);
    case PlyScalar::Int32:
      return std::in_range<std::int32_t>(value);
    case PlyScalar::UInt32:
      return std::in_range<std::uint32_t>(value);
    default:
      return false;
  }
}

PlyHeader read_ply_header(const MeshSource& source) { return HeaderReader(source).read(); }

}  // namespace palpation
