#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/byte_order.h"
#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/polygon_soup.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr std::size_t kMostElements = 64;
constexpr std::size_t kMostProperties = 256;
constexpr std::size_t kLongestHeaderLine = 4096;

enum class Encoding { Ascii, Little, Big };
enum class Scalar { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct Property {
  std::string name;
  Scalar type = Scalar::Float64;
  std::optional<Scalar> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
  std::int64_t line = 0;
};

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes
  std::int64_t lines = 0;
};

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::Int8:
    case Scalar::UInt8:
      return 1;
    case Scalar::Int16:
    case Scalar::UInt16:
      return 2;
    case Scalar::Int32:
    case Scalar::UInt32:
    case Scalar::Float32:
      return 4;
    case Scalar::Float64:
      return 8;
  }
  return 8;
}

bool is_real(Scalar type) { return type == Scalar::Float32 || type == Scalar::Float64; }

/// Whether a whole number is one that the type holds.
bool holds(Scalar type, std::int64_t value) {
  switch (type) {
    case Scalar::Int8:
      return std::in_range<std::int8_t>(value);
    case Scalar::UInt8:
      return std::in_range<std::uint8_t>(value);
    case Scalar::Int16:
      return std::in_range<std::int16_t>(value);
    case Scalar::UInt16:
      return std::in_range<std::uint16_t>(value);
    case Scalar::Int32:
      return std::in_range<std::int32_t>(value);
    case Scalar::UInt32:
      return std::in_range<std::uint32_t>(value);
    default:
      return false;
  }
}

std::optional<Scalar> scalar_of(std::string_view name) {
  if (name == "char" || name == "int8") return Scalar::Int8;
  if (name == "uchar" || name == "uint8") return Scalar::UInt8;
  if (name == "short" || name == "int16") return Scalar::Int16;
  if (name == "ushort" || name == "uint16") return Scalar::UInt16;
  if (name == "int" || name == "int32") return Scalar::Int32;
  if (name == "uint" || name == "uint32") return Scalar::UInt32;
  if (name == "float" || name == "float32") return Scalar::Float32;
  if (name == "double" || name == "float64") return Scalar::Float64;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const MeshSource& source) : source_(source) {}

  Header read() {
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
  /// Header lines all end like the first: after CR alone, a line feed may be the first byte of
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
      header_.encoding = Encoding::Ascii;
    } else if (words_[1] == "binary_little_endian") {
      header_.encoding = Encoding::Little;
    } else if (words_[1] == "binary_big_endian") {
      header_.encoding = Encoding::Big;
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
    for (const Element& element : header_.elements) {
      if (element.name == name) fail("element " + in_quotes(name) + " appears twice");
    }
    // They would be faces, left out without a word.
    if (name == "tristrips" && *count > 0)
      fail("strips of triangles are not read: write them as faces");
    header_.elements.push_back({name, *count, {}, line_});
  }

  void take_property() {
    if (header_.elements.empty()) fail("a property before the first element");
    Element& element = header_.elements.back();
    if (element.properties.size() == kMostProperties)
      fail("more than 256 properties of element " + in_quotes(element.name));
    Property property;
    if (words_.size() == 5 && words_[1] == "list") {
      property = {std::string(words_[4]), type_of(words_[3]), type_of(words_[2])};
      if (is_real(*property.count_type))
        fail("a list's count must be a whole number, not " + in_quotes(words_[2]));
    } else if (words_.size() == 3) {
      property = {std::string(words_[2]), type_of(words_[1]), std::nullopt};
    } else {
      fail("\"property <type> <name>\" or \"property list <type> <type> <name>\" is expected");
    }
    for (const Property& other : element.properties) {
      if (other.name == property.name)
        fail("property " + in_quotes(property.name) + " of element " + in_quotes(element.name) +
             " appears twice");
    }
    element.properties.push_back(property);
  }

  Scalar type_of(std::string_view name) const {
    const std::optional<Scalar> type = scalar_of(name);
    if (!type) fail(in_quotes(name) + " is no type");
    return *type;
  }

  [[noreturn]] void fail(const std::string& what) const { source_.fail_at_line(line_, what); }

  const MeshSource& source_;
  Header header_;
  std::vector<std::string_view> words_;
  std::string_view line_end_ = "\n";
  std::size_t position_ = 0;
  std::int64_t line_ = 0;
  bool has_format_ = false;
  bool done_ = false;
};

/// The numbers of a binary body, one after the other.
class BinaryBody {
 public:
  BinaryBody(const MeshSource& source, const Header& header)
      : source_(source),
        position_(header.size),
        order_(header.encoding == Encoding::Big ? ByteOrder::Big : ByteOrder::Little) {}

  std::int64_t bytes_left() const {
    return static_cast<std::int64_t>(source_.bytes.size() - position_);
  }
  static std::int64_t least_size(Scalar type) { return static_cast<std::int64_t>(size_of(type)); }
  static constexpr PlaceKind kPlaceKind = PlaceKind::Byte;
  std::int64_t place() const { return static_cast<std::int64_t>(position_); }
  std::int64_t warned_underflows() const { return 0; }
  static void begin_record() {}

  double real(Scalar type, std::string_view what) {
    return is_real(type) ? real_number(type, what) : static_cast<double>(integer(type, what));
  }

  std::int64_t integer(Scalar type, std::string_view what) {
    const std::string_view bytes = take(type, what);
    switch (type) {
      case Scalar::Int8:
        return number_from<std::int8_t>(bytes, order_);
      case Scalar::UInt8:
        return number_from<std::uint8_t>(bytes, order_);
      case Scalar::Int16:
        return number_from<std::int16_t>(bytes, order_);
      case Scalar::UInt16:
        return number_from<std::uint16_t>(bytes, order_);
      case Scalar::Int32:
        return number_from<std::int32_t>(bytes, order_);
      case Scalar::UInt32:
        return number_from<std::uint32_t>(bytes, order_);
      default:
        fail("a whole number is expected for " + std::string(what));
    }
  }

  void skip(Scalar type, std::string_view what) { take(type, what); }

  void expect_end() const {
    if (bytes_left() > 0)
      source_.fail_at_byte(position_,
                           std::to_string(bytes_left()) + " bytes more than the header announces");
  }

  /// At the number read last.
  [[noreturn]] void fail(const std::string& what) const { source_.fail_at_byte(last_, what); }

 private:
  double real_number(Scalar type, std::string_view what) {
    const std::string_view bytes = take(type, what);
    return type == Scalar::Float32 ? double{number_from<float>(bytes, order_)}
                                   : number_from<double>(bytes, order_);
  }

  std::string_view take(Scalar type, std::string_view what) {
    const std::size_t size = size_of(type);
    last_ = position_;
    if (source_.bytes.size() - position_ < size)
      fail("the file ends where " + std::string(what) + " is expected");
    position_ += size;
    return source_.bytes.substr(position_ - size, size);
  }

  const MeshSource& source_;
  std::size_t position_;
  std::size_t last_ = 0;
  ByteOrder order_;
};

/// The same for an ASCII body, where every record has a line of its own.
class AsciiBody {
 public:
  AsciiBody(const MeshSource& source, const Header& header)
      : source_(source), words_(source.bytes.substr(header.size), header.lines + 1) {
    source.refuse_nul_bytes();
  }

  // The last number may have no separator behind it.
  std::int64_t bytes_left() const { return static_cast<std::int64_t>(words_.bytes_left()) + 1; }
  static std::int64_t least_size(Scalar) { return 2; }
  static constexpr PlaceKind kPlaceKind = PlaceKind::Line;
  std::int64_t place() const { return words_.line(); }
  std::int64_t warned_underflows() const { return underflows_; }
  void begin_record() { is_first_of_record_ = true; }

  double real(Scalar type, std::string_view what) {
    if (!is_real(type)) return static_cast<double>(integer(type, what));
    const std::string_view word = next(what);
    const ParsedNumber number = parse_number(word);
    if (number.status == NumberStatus::NotANumber)
      fail(std::string(what) + " = " + in_quotes(word) + " is not a number");
    if (number.status == NumberStatus::TooLarge)
      fail(std::string(what) + " = " + in_quotes(word) + " is too large for a double");
    if (number.status == NumberStatus::Underflow) ++underflows_;
    return number.value;
  }

  std::int64_t integer(Scalar type, std::string_view what) {
    const std::string_view word = next(what);
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value || !holds(type, *value))
      fail(std::string(what) + " = " + in_quotes(word) +
           " is not a whole number that fits its type");
    return *value;
  }

  void skip(Scalar, std::string_view what) {
    const std::string_view word = next(what);
    if (parse_number(word).status == NumberStatus::NotANumber)
      fail(std::string(what) + " = " + in_quotes(word) + " is not a number");
  }

  void expect_end() {
    if (words_.next()) fail("more numbers than the header announces");
  }

  [[noreturn]] void fail(const std::string& what) const {
    source_.fail_at_line(words_.line(), what);
  }

 private:
  std::string_view next(std::string_view what) {
    const std::int64_t line_before = words_.line();
    const std::optional<std::string_view> word = words_.next();
    if (!word) fail("the file ends where " + std::string(what) + " is expected");
    if (is_first_of_record_ && line_before == words_.line() && !is_first_of_all_)
      fail("more numbers on the line than the header announces");
    if (!is_first_of_record_ && line_before != words_.line())
      source_.fail_at_line(line_before,
                           "the line ends where " + std::string(what) + " is expected");
    is_first_of_record_ = is_first_of_all_ = false;
    return *word;
  }

  const MeshSource& source_;
  WordCursor words_;
  bool is_first_of_record_ = true, is_first_of_all_ = true;
  std::int64_t underflows_ = 0;
};

template <typename Body>
class BodyReader {
 public:
  BodyReader(const MeshSource& source, const Header& header)
      : source_(source), header_(header), body_(source, header) {
    soup_.place_kind = Body::kPlaceKind;
  }

  PolygonSoup read() {
    for (const Element& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip_element(element);
      }
    }
    body_.expect_end();
    soup_.warn_of_underflows(body_.warned_underflows());
    return std::move(soup_);
  }

 private:
  /// Before anything is allocated: as many records as announced must fit into the bytes that are
  /// left.
  void check_count(const Element& element) const {
    std::int64_t least = 0;
    for (const Property& property : element.properties)
      least += Body::least_size(property.count_type.value_or(property.type));
    const bool fits = least == 0 || element.count <= body_.bytes_left() / least;
    if (fits && element.count <= std::numeric_limits<int>::max()) return;
    source_.fail_at_line(element.line, std::to_string(element.count) + " of element " +
                                           in_quotes(element.name) + " do not fit into the " +
                                           std::to_string(body_.bytes_left()) + " bytes left");
  }

  void read_vertices(const Element& element) {
    // Which property is x, y, z, and -1 for the others.
    std::vector<int> component(element.properties.size(), -1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                      [&](const Property& p) { return p.name == name; });
      if (found == element.properties.end() || found->count_type) {
        source_.fail_at_line(element.line, "element \"vertex\" has no number \"" + name + "\"");
      }
      component[static_cast<std::size_t>(found - element.properties.begin())] = axis;
    }
    soup_.points.reserve(static_cast<std::size_t>(element.count));
    for (std::int64_t vertex = 0; vertex < element.count; ++vertex)
      read_vertex(element, component, vertex);
  }

  void read_vertex(const Element& element, const std::vector<int>& component, std::int64_t vertex) {
    body_.begin_record();
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; i < component.size(); ++i) {
      const Property& property = element.properties[i];
      if (component[i] < 0) {
        skip_property(property);
        continue;
      }
      const double value = body_.real(property.type, property.name);
      if (!std::isfinite(value))
        body_.fail("vertex " + std::to_string(vertex) + ": " + property.name + " = " +
                   text_of(value) + " is not finite");
      point[component[i]] = value;
    }
    soup_.points.push_back(point);
  }

  void read_faces(const Element& element) {
    const auto is_corner_list = [](const Property& p) {
      return p.name == "vertex_indices" || p.name == "vertex_index";
    };
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(), is_corner_list);
    if (found == element.properties.end() || !found->count_type || is_real(found->type)) {
      source_.fail_at_line(element.line,
                           "element \"face\" has no list of whole numbers \"vertex_indices\"");
    }
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) > 1)
      source_.fail_at_line(element.line,
                           "element \"face\" has both \"vertex_indices\" and \"vertex_index\"");
    for (std::int64_t face = 0; face < element.count; ++face) {
      body_.begin_record();
      for (const Property& property : element.properties) {
        if (&property == &*found) {
          read_corners(property);
        } else {
          skip_property(property);
        }
      }
    }
  }

  void read_corners(const Property& property) {
    const std::int64_t start = body_.place();
    const std::int64_t count = list_length(property);
    // Words know their line once they are read.
    soup_.begin_face(Body::kPlaceKind == PlaceKind::Byte ? start : body_.place());
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t index = body_.integer(property.type, "a vertex index");
      if (index < 0 || index > std::numeric_limits<int>::max()) {
        body_.fail("face " + std::to_string(soup_.face_count() - 1) + ": vertex index " +
                   std::to_string(index) + " is out of range 0 to " +
                   std::to_string(static_cast<std::int64_t>(soup_.points.size()) - 1));
      }
      soup_.corners.push_back(static_cast<int>(index));
    }
    soup_.end_face(source_);
  }

  std::int64_t list_length(const Property& property) {
    const std::int64_t count = body_.integer(*property.count_type, "the length of a list");
    if (count < 0 || count > body_.bytes_left() / Body::least_size(property.type)) {
      body_.fail("a list " + in_quotes(property.name) + " of " + std::to_string(count) +
                 " numbers does not fit into the " + std::to_string(body_.bytes_left()) +
                 " bytes left");
    }
    return count;
  }

  void skip_property(const Property& property) {
    const std::int64_t count = property.count_type ? list_length(property) : 1;
    for (std::int64_t i = 0; i < count; ++i) body_.skip(property.type, property.name);
  }

  void skip_element(const Element& element) {
    if (element.properties.empty()) return;
    for (std::int64_t i = 0; i < element.count; ++i) {
      body_.begin_record();
      for (const Property& property : element.properties) skip_property(property);
    }
  }

  const MeshSource& source_;
  const Header& header_;
  Body body_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(const MeshSource& source) {
  const Header header = HeaderReader(source).read();
  if (header.encoding != Encoding::Ascii) {
    PolygonSoup soup = BodyReader<BinaryBody>(source, header).read();
    soup.format = header.encoding == Encoding::Big ? "binary PLY, big-endian" : "binary PLY";
    return soup;
  }
  PolygonSoup soup = BodyReader<AsciiBody>(source, header).read();
  soup.format = "ASCII PLY";
  return soup;
}

}  // namespace palpation
