#include "io/vtp_array.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "io/mesh_text.h"
#include "io/number_text.h"

namespace palpation {
namespace {

constexpr std::uint64_t kFreeNumbers = 3'000'000;
constexpr std::int64_t kMostComponents = 4096;

struct NamedType {
  std::string_view name;
  VtpType type;
};
constexpr std::array<NamedType, 12> kTypes = {{{"Int8", VtpType::Int8},
                                               {"UInt8", VtpType::UInt8},
                                               {"Int16", VtpType::Int16},
                                               {"UInt16", VtpType::UInt16},
                                               {"Int32", VtpType::Int32},
                                               {"UInt32", VtpType::UInt32},
                                               {"Int64", VtpType::Int64},
                                               {"UInt64", VtpType::UInt64},
                                               {"Float32", VtpType::Float32},
                                               {"Float64", VtpType::Float64},
                                               {"Bit", VtpType::Bit},
                                               {"String", VtpType::String}}};

bool is_real(VtpType type) { return type == VtpType::Float32 || type == VtpType::Float64; }

/// Calls `visit` with a value of the type that the numbers have; bits and texts have none.
template <typename Visit>
void with_number_of(VtpType type, Visit visit) {
  switch (type) {
    case VtpType::Int8:
      return visit(std::int8_t{});
    case VtpType::UInt8:
      return visit(std::uint8_t{});
    case VtpType::Int16:
      return visit(std::int16_t{});
    case VtpType::UInt16:
      return visit(std::uint16_t{});
    case VtpType::Int32:
      return visit(std::int32_t{});
    case VtpType::UInt32:
      return visit(std::uint32_t{});
    case VtpType::Int64:
      return visit(std::int64_t{});
    case VtpType::UInt64:
      return visit(std::uint64_t{});
    case VtpType::Float32:
      return visit(float{});
    case VtpType::Float64:
      return visit(double{});
    case VtpType::Bit:
    case VtpType::String:
      return;
  }
}

std::uint64_t size_of(VtpType type, std::uint64_t count) {
  std::uint64_t size = type == VtpType::Bit ? (count + 7) / 8 : count;
  with_number_of(type, [&](auto number) { size = count * sizeof number; });
  return size;
}

/// Whole numbers as VTK's types hold them; what no 64 bits with a sign hold is an index of nothing.
std::optional<std::int64_t> fitting(std::int64_t value, VtpType type) {
  bool fits = type != VtpType::Bit || (value == 0 || value == 1);
  with_number_of(type, [&]<typename Number>(Number) {
    if constexpr (std::numeric_limits<Number>::is_integer) fits = std::in_range<Number>(value);
  });
  return fits ? std::optional(value) : std::nullopt;
}

/// Every word of an array that is written as text.
template <typename Take>
void each_word(const MeshSource& source, const VtpArray& array, std::int64_t count,
               const std::string& what, Take take) {
  WordCursor words(array.text);
  std::int64_t found = 0;
  for (std::optional<std::string_view> word = words.next(); word; word = words.next()) {
    const auto fail = [&](const std::string& rule) {
      source.fail_at_byte(static_cast<std::size_t>(word->data() - source.bytes.data()),
                          what + ", number " + std::to_string(found - 1) + ": " + rule);
    };
    if (found++ == count) fail("more numbers than the " + std::to_string(count) + " expected");
    take(*word, fail);
  }
  if (found == count) return;
  source.fail_at_byte(
      array.place, what + ": " + std::to_string(found) + " numbers, not " + std::to_string(count));
}

template <typename Fail>
double real_of(std::string_view word, std::int64_t& underflows, Fail fail) {
  const ParsedNumber number = parse_number(word);
  if (number.status == NumberStatus::NotANumber) fail(in_quotes(word) + " is not a number");
  if (number.status == NumberStatus::TooLarge) fail(in_quotes(word) + " is too large for a double");
  if (number.status == NumberStatus::Underflow) ++underflows;
  return number.value;
}

template <typename Fail>
std::int64_t integer_of(std::string_view word, VtpType type, Fail fail) {
  const std::optional<std::int64_t> number = parse_integer(word);
  if (!number || !fitting(*number, type))
    fail(in_quotes(word) + " is no whole number that fits the array's type");
  return *number;
}

std::uint64_t count_attribute(const MeshSource& source, const XmlTag& tag, std::string_view name,
                              std::int64_t most, std::int64_t otherwise) {
  const std::optional<std::string> text = tag.attribute(name);
  if (!text) return static_cast<std::uint64_t>(otherwise);
  const std::optional<std::int64_t> value = parse_integer(without_blanks_around(*text));
  if (value && *value >= 0 && *value <= most) return static_cast<std::uint64_t>(*value);
  source.fail_at_byte(tag.place, std::string(name) + " = " + in_quotes(*text) +
                                     " must be a whole number from 0 to " + std::to_string(most));
}

VtpFormat format_of(const MeshSource& source, const XmlTag& tag) {
  const std::string format = tag.attribute("format").value_or("");
  // VTK goes by the offset, whatever the format says.
  const bool known = format == "ascii" || format == "binary" || format == "appended";
  if (!known || tag.attribute("offset").has_value() != (format == "appended")) {
    source.fail_at_byte(tag.place,
                        "an array's format must be ascii, binary, or appended with an offset");
  }
  if (format == "ascii") return VtpFormat::Ascii;
  return format == "binary" ? VtpFormat::Binary : VtpFormat::Appended;
}

}  // namespace

VtpArray vtp_array(const MeshSource& source, const XmlTag& tag) {
  VtpArray array;
  array.place = tag.place;
  array.name = tag.attribute("Name").value_or("");
  array.format = format_of(source, tag);
  array.components = static_cast<std::int64_t>(
      count_attribute(source, tag, "NumberOfComponents", kMostComponents, 1));
  array.offset =
      count_attribute(source, tag, "offset", std::numeric_limits<std::int64_t>::max(), 0);
  const std::string type = tag.attribute("type").value_or("");
  const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                  [&](const NamedType& named) { return named.name == type; });
  if (found == kTypes.end()) {
    source.fail_at_byte(tag.place, "array " + in_quotes(array.name) + ": " + in_quotes(type) +
                                       " is no type of an array in a VTK file");
  }
  array.type = found->type;
  return array;
}

void VtpNumbers::each_real(const VtpArray& array, std::int64_t count, const std::string& what,
                           const std::function<void(double)>& take) {
  if (array.type == VtpType::Bit || array.type == VtpType::String)
    source_.fail_at_byte(array.place, what + ": must be numbers");
  if (array.format == VtpFormat::Ascii) {
    return each_word(source_, array, count, what, [&](std::string_view word, auto fail) {
      take(is_real(array.type) ? real_of(word, underflows_, fail)
                               : static_cast<double>(integer_of(word, array.type, fail)));
    });
  }
  check_size(array, count, what);
  spend(array, static_cast<std::uint64_t>(count));
  VtpBytes bytes = bytes_of(array, what);
  const std::string_view numbers = bytes.unpacked();
  with_number_of(array.type, [&]<typename Number>(Number) {
    for (std::size_t at = 0; at < numbers.size(); at += sizeof(Number))
      take(static_cast<double>(number_from<Number>(numbers.substr(at), layout_.order)));
  });
}

void VtpNumbers::each_integer(const VtpArray& array, std::int64_t count, const std::string& what,
                              const std::function<void(std::int64_t)>& take) {
  if (is_real(array.type) || array.type == VtpType::Bit || array.type == VtpType::String)
    source_.fail_at_byte(array.place, what + ": must be whole numbers");
  if (array.format == VtpFormat::Ascii) {
    return each_word(source_, array, count, what, [&](std::string_view word, auto fail) {
      take(integer_of(word, array.type, fail));
    });
  }
  check_size(array, count, what);
  spend(array, static_cast<std::uint64_t>(count));
  VtpBytes bytes = bytes_of(array, what);
  const std::string_view numbers = bytes.unpacked();
  with_number_of(array.type, [&]<typename Number>(Number) {
    for (std::size_t at = 0; at < numbers.size(); at += sizeof(Number)) {
      const Number value = number_from<Number>(numbers.substr(at), layout_.order);
      if constexpr (std::numeric_limits<Number>::is_integer) {
        if (!std::in_range<std::int64_t>(value))
          source_.fail_at_byte(array.place,
                               what + ": " + std::to_string(value) + " is out of range");
        take(static_cast<std::int64_t>(value));
      }
    }
  });
}

/// Texts are written one after the other, each with a NUL behind it; as ASCII, each character is
/// its number.
std::vector<std::string> VtpNumbers::texts(const VtpArray& array, std::int64_t count,
                                           const std::string& what) {
  if (array.type != VtpType::String) source_.fail_at_byte(array.place, what + ": must be texts");
  std::vector<std::string> texts;
  std::string text;
  for (const char character : characters_of(array, what)) {
    if (character != '\0') {
      text += character;
      continue;
    }
    if (static_cast<std::int64_t>(texts.size()) == count)
      source_.fail_at_byte(array.place,
                           what + ": more texts than the " + std::to_string(count) + " expected");
    texts.push_back(std::move(text));
    text.clear();
  }
  if (static_cast<std::int64_t>(texts.size()) != count || !text.empty())
    source_.fail_at_byte(array.place, what + ": " + std::to_string(texts.size()) + " texts, not " +
                                          std::to_string(count));
  return texts;
}

void VtpNumbers::check_size(const VtpArray& array, std::int64_t count,
                            const std::string& what) const {
  if (array.format == VtpFormat::Ascii) {
    if (count <= static_cast<std::int64_t>(array.text.size() / 2 + 1)) return;
    source_.fail_at_byte(array.place, what + ": " + std::to_string(array.text.size()) +
                                          " characters cannot hold " + std::to_string(count) +
                                          " numbers");
  }
  const std::uint64_t size = bytes_of(array, what).size();
  if (size == size_of(array.type, static_cast<std::uint64_t>(count))) return;
  source_.fail_at_byte(array.place,
                       what + ": " + std::to_string(size) + " bytes, but " + std::to_string(count) +
                           " numbers of its type have " +
                           std::to_string(size_of(array.type, static_cast<std::uint64_t>(count))));
}

void VtpNumbers::check(const VtpArray& array, std::int64_t count, const std::string& what) {
  if (array.type == VtpType::String) {
    texts(array, count, what);
    return;
  }
  if (array.format == VtpFormat::Ascii) {
    std::int64_t ignored = 0;
    return each_word(source_, array, count, what, [&](std::string_view word, auto fail) {
      if (is_real(array.type)) {
        real_of(word, ignored, fail);
      } else {
        integer_of(word, array.type, fail);
      }
    });
  }
  check_size(array, count, what);
}

VtpBytes VtpNumbers::bytes_of(const VtpArray& array, const std::string& what) const {
  if (array.format == VtpFormat::Binary)
    return VtpBytes(source_, layout_, array.text, /*is_base64=*/true, /*is_whole=*/true);
  if (!layout_.appended)
    source_.fail_at_byte(array.place, what + ": the file has no appended data");
  if (array.offset >= layout_.appended->size()) {
    source_.fail_at_byte(array.place,
                         what + ": offset " + std::to_string(array.offset) + " points behind the " +
                             std::to_string(layout_.appended->size()) + " bytes of appended data");
  }
  return VtpBytes(source_, layout_, layout_.appended->substr(array.offset),
                  layout_.appended_is_base64, /*is_whole=*/false);
}

void VtpNumbers::spend(const VtpArray& array, std::uint64_t numbers) {
  spent_ += numbers;
  if (spent_ <= kFreeNumbers + source_.bytes.size()) return;
  source_.fail_at_byte(array.place,
                       "unpacked, the file holds more than " +
                           std::to_string(kFreeNumbers + source_.bytes.size()) +
                           " numbers, too many for its size: write it without compression");
}

std::string VtpNumbers::characters_of(const VtpArray& array, const std::string& what) {
  std::string characters;
  if (array.format == VtpFormat::Ascii) {
    WordCursor words(array.text);
    for (std::optional<std::string_view> word = words.next(); word; word = words.next()) {
      const std::optional<std::int64_t> code = parse_integer(*word);
      if (!code || *code < -128 || *code > 255)
        source_.fail_at_byte(static_cast<std::size_t>(word->data() - source_.bytes.data()),
                             what + ": " + in_quotes(*word) + " is no character's number");
      characters += static_cast<char>(static_cast<unsigned char>(*code));
    }
    return characters;
  }
  VtpBytes bytes = bytes_of(array, what);
  spend(array, bytes.size() / 8);
  return std::string(bytes.unpacked());
}

}  // namespace palpation
