/// The arrays of a VTP file: what each says of itself, and its numbers, whichever way they are
/// written.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_source.h"
#include "io/vtp_bytes.h"
#include "io/xml_cursor.h"

namespace palpation {

enum class VtpType {
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64,
  Bit,
  String
};
enum class VtpFormat { Ascii, Binary, Appended };

struct VtpArray {
  std::string name;
  VtpType type = VtpType::Float32;
  VtpFormat format = VtpFormat::Ascii;
  std::int64_t components = 1;
  std::uint64_t offset = 0;  ///< of appended bytes
  std::string_view text;     ///< in the element, where bytes are not appended
  std::size_t place = 0;     ///< byte of the tag
};

/// What the tag of an array says. Throws IoError naming the byte.
VtpArray vtp_array(const MeshSource& source, const XmlTag& tag);

/// Reads numbers out of arrays. Each function takes how many numbers the array must hold, and
/// `what` it is, for messages. Each throws IoError naming the byte where the array holds another
/// number of them, or something that is none. Nothing is allocated before the bytes are known to be
/// there, and in all there may be three million numbers more than the file has bytes, or a small
/// file could unpack to fill any memory.
class VtpNumbers {
 public:
  VtpNumbers(const MeshSource& source, const VtpLayout& layout)
      : source_(source), layout_(layout) {}

  void each_real(const VtpArray& array, std::int64_t count, const std::string& what,
                 const std::function<void(double)>& take);
  void each_integer(const VtpArray& array, std::int64_t count, const std::string& what,
                    const std::function<void(std::int64_t)>& take);
  std::vector<std::string> texts(const VtpArray& array, std::int64_t count,
                                 const std::string& what);
  /// That the bytes can hold so many numbers, without a look at them.
  void check_size(const VtpArray& array, std::int64_t count, const std::string& what) const;
  /// That the numbers are there.
  void check(const VtpArray& array, std::int64_t count, const std::string& what);

  /// How many numbers were too small for a double, and given as 0.
  std::int64_t underflows() const { return underflows_; }

 private:
  VtpBytes bytes_of(const VtpArray& array, const std::string& what) const;
  void spend(const VtpArray& array, std::uint64_t numbers);
  std::string characters_of(const VtpArray& array, const std::string& what);

  const MeshSource& source_;
  const VtpLayout& layout_;
  std::uint64_t spent_ = 0;
  std::int64_t underflows_ = 0;
};

}  // namespace palpation
