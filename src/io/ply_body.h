/// The body of a PLY file as one number after the other, binary or ASCII: two classes that are read
/// alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/byte_order.h"
#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/ply_header.h"
#include "io/polygon_soup.h"

namespace palpation {

/// The numbers of a binary body, one after the other.
class PlyBinaryBody {
 public:
  PlyBinaryBody(const MeshSource& source, const PlyHeader& header)
      : source_(source),
        position_(header.size),
        order_(header.encoding == PlyEncoding::Big ? ByteOrder::Big : ByteOrder::Little) {}

  std::int64_t bytes_left() const {
    return static_cast<std::int64_t>(source_.bytes.size() - position_);
  }
  static std::int64_t least_size(PlyScalar type) {
    return static_cast<std::int64_t>(size_of(type));
  }
  static constexpr PlaceKind kPlaceKind = PlaceKind::Byte;
  std::int64_t place() const { return static_cast<std::int64_t>(position_); }
  std::int64_t warned_underflows() const { return 0; }
  static void begin_record() {}

  double real(PlyScalar type, std::string_view what) {
    return is_real(type) ? real_number(type, what) : static_cast<double>(integer(type, what));
  }

  std::int64_t integer(PlyScalar type, std::string_view what) {
    const std::string_view bytes = take(type, what);
    switch (type) {
      case PlyScalar::Int8:
        return number_from<std::int8_t>(bytes, order_);
      case PlyScalar::UInt8:
        return number_from<std::uint8_t>(bytes, order_);
      case PlyScalar::Int16:
        return number_from<std::int16_t>(bytes, order_);
      case PlyScalar::UInt16:
        return number_from<std::uint16_t>(bytes, order_);
      case PlyScalar::Int32:
        return number_from<std::int32_t>(bytes, order_);
      case PlyScalar::UInt32:
        return number_from<std::uint32_t>(bytes, order_);
      default:
        fail("a whole number is expected for " + std::string(what));
    }
  }

  void skip(PlyScalar type, std::string_view what) { take(type, what); }

  void expect_end() const {
    if (bytes_left() > 0)
      source_.fail_at_byte(position_,
                           std::to_string(bytes_left()) + " bytes more than the header announces");
  }

  /// At the number read last.
  [[noreturn]] void fail(const std::string& what) const { source_.fail_at_byte(last_, what); }

 private:
  double real_number(PlyScalar type, std::string_view what) {
    const std::string_view bytes = take(type, what);
    return type == PlyScalar::Float32 ? double{number_from<float>(bytes, order_)}
                                      : number_from<double>(bytes, order_);
  }

  std::string_view take(PlyScalar type, std::string_view what) {
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
class PlyAsciiBody {
 public:
  PlyAsciiBody(const MeshSource& source, const PlyHeader& header)
      : source_(source), words_(source.bytes.substr(header.size), header.lines + 1) {
    source.refuse_nul_bytes();
  }

  // The last number may have no separator behind it.
  std::int64_t bytes_left() const { return static_cast<std::int64_t>(words_.bytes_left()) + 1; }
  static std::int64_t least_size(PlyScalar) { return 2; }
  static constexpr PlaceKind kPlaceKind = PlaceKind::Line;
  std::int64_t place() const { return words_.line(); }
  std::int64_t warned_underflows() const { return underflows_; }
  void begin_record() { is_first_of_record_ = true; }

  double real(PlyScalar type, std::string_view what) {
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

  std::int64_t integer(PlyScalar type, std::string_view what) {
    const std::string_view word = next(what);
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value || !holds(type, *value))
      fail(std::string(what) + " = " + in_quotes(word) +
           " is not a whole number that fits its type");
    return *value;
  }

  void skip(PlyScalar, std::string_view what) {
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

}  // namespace palpation
