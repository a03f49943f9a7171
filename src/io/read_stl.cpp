#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/byte_order.h"
#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/polygon_soup.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kFacet = 50;

/// Counts the facets whose normal looks to the other side than the order of their corners. Normals
/// may be zero, or no number.
class NormalCheck {
 public:
  void take(const Vec3& normal, const PolygonSoup& soup) {
    const Vec3* corner = soup.points.data() + soup.points.size() - 3;
    if (normal.dot((corner[1] - corner[0]).cross(corner[2] - corner[0])) < 0.0) ++opposed_;
  }
  void warn(PolygonSoup& soup) const {
    if (opposed_ == 0) return;
    soup.warn(
        std::to_string(opposed_) +
            " facets have a normal that contradicts the order of their corners: the order counts.",
        "Look at the mesh in a viewer: if it shows its inside, flip all faces in a mesh editor.");
  }

 private:
  std::int64_t opposed_ = 0;
};

/// Three corners of their own for each facet, until equal ones are welded.
void push_corner(PolygonSoup& soup, const Vec3& point) {
  soup.corners.push_back(static_cast<int>(soup.points.size()));
  // Adding 0 turns -0 into 0, so that equal corners have equal bits.
  soup.points.push_back(point + Vec3::Zero());
}

class AsciiStlReader {
 public:
  explicit AsciiStlReader(const MeshSource& source)
      : source_(source), words_(source.bytes), coordinates_(source) {
    soup_.format = "ASCII STL";
    soup_.place_kind = PlaceKind::Line;
  }

  PolygonSoup read() {
    source_.refuse_nul_bytes();
    while (const std::optional<std::string_view> word = words_.next()) {
      if (lower_case(*word) != "solid")
        source_.fail_at_line(words_.line(), "\"solid\" is expected, not " + in_quotes(*word));
      skip_name();
      read_solid();
      ++solids_;
    }
    soup_.warn_of_underflows(coordinates_.underflows());
    normals_.warn(soup_);
    if (solids_ > 1) {
      soup_.warn(
          "The file holds " + std::to_string(solids_) + " solids, which were read as one mesh.",
          "Harmless if all of them are tissue. Otherwise delete the others from the file.");
    }
    weld_equal_points(soup_);
    return std::move(soup_);
  }

 private:
  void read_solid() {
    while (true) {
      const std::string word = lower_case(next_word("facet or endsolid"));
      if (word == "endsolid") break;
      if (word != "facet")
        source_.fail_at_line(words_.line(),
                             "\"facet\" or \"endsolid\" is expected, not " + in_quotes(word));
      read_facet();
    }
    skip_name();
  }

  /// What is left of the line of solid or endsolid is a name, unless writers forgot to end the
  /// line.
  void skip_name() {
    if (words_.skip_line().find("facet normal") == std::string_view::npos) return;
    source_.fail_at_line(words_.line(),
                         "a facet stands where the name of the solid ends with its line: break the "
                         "line in front of it");
  }

  void read_facet() {
    soup_.begin_face(words_.line());
    expect("normal");
    Vec3 normal;
    for (double& component : normal) component = normal_component();
    expect("outer");
    expect("loop");
    for (int i = 0; i < 3; ++i) read_vertex();
    normals_.take(normal, soup_);
    expect("endloop");
    expect("endfacet");
  }

  double normal_component() {
    const std::string_view word = next_word("a normal");
    const ParsedNumber number = parse_number(word);
    if (number.status == NumberStatus::NotANumber)
      source_.fail_at_line(words_.line(),
                           in_facet("its normal has " + in_quotes(word) + ", which is no number"));
    return number.value;
  }

  void read_vertex() {
    expect("vertex");
    const std::int64_t line = words_.line();
    std::array<std::string_view, 3> numbers;
    for (std::string_view& number : numbers) {
      number = next_word("a coordinate");
      if (words_.line() != line)
        source_.fail_at_line(line, in_facet("a vertex has 3 coordinates on its line"));
    }
    push_corner(soup_,
                coordinates_.point(numbers, static_cast<std::int64_t>(soup_.points.size()), line));
  }

  std::string_view next_word(const std::string& what) {
    const std::optional<std::string_view> word = words_.next();
    if (!word)
      source_.fail_at_line(words_.line(), in_facet("the file ends where " + what + " is expected"));
    return *word;
  }

  void expect(const std::string& keyword) {
    const std::string_view word = next_word(keyword);
    if (lower_case(word) != keyword)
      source_.fail_at_line(words_.line(),
                           in_facet("\"" + keyword + "\" is expected, not " + in_quotes(word)));
  }

  std::string in_facet(const std::string& what) const {
    return soup_.face_count() == 0
               ? what
               : "facet " + std::to_string(soup_.face_count() - 1) + ": " + what;
  }

  const MeshSource& source_;
  WordCursor words_;
  CoordinateReader coordinates_;
  NormalCheck normals_;
  PolygonSoup soup_;
  int solids_ = 0;
};

std::uint32_t facet_count(std::string_view bytes) {
  return number_from<std::uint32_t>(bytes.substr(80), ByteOrder::Little);
}

Vec3 binary_vector(const MeshSource& source, std::size_t byte) {
  Vec3 vector;
  for (std::size_t i = 0; i < 3; ++i)
    vector[i] = double{number_from<float>(source.bytes.substr(byte + 4 * i), ByteOrder::Little)};
  return vector;
}

Vec3 binary_corner(const MeshSource& source, std::size_t byte, std::size_t facet) {
  Vec3 point;
  for (int component = 0; component < 3; ++component) {
    const std::size_t at = byte + 4 * static_cast<std::size_t>(component);
    const auto value = number_from<float>(source.bytes.substr(at), ByteOrder::Little);
    if (!std::isfinite(value)) {
      source.fail_at_byte(at, "facet " + std::to_string(facet) + ": " + "xyz"[component] + " = " +
                                  text_of(double{value}) + " is not finite");
    }
    point[component] = double{value};
  }
  return point;
}

}  // namespace

bool has_size_of_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader &&
         bytes.size() == kHeader + kFacet * std::size_t{facet_count(bytes)};
}

PolygonSoup read_ascii_stl(const MeshSource& source) { return AsciiStlReader(source).read(); }

PolygonSoup read_binary_stl(const MeshSource& source) {
  if (source.bytes.size() < kHeader) {
    source.fail_at_byte(source.bytes.size(),
                        "the file ends inside the header of a binary STL, which is 84 bytes long");
  }
  const std::size_t count = facet_count(source.bytes);
  if (!has_size_of_binary_stl(source.bytes)) {
    const std::size_t needed = kHeader + kFacet * count;
    source.fail_at_byte(
        80, std::to_string(count) + " facets make " + std::to_string(needed) +
                " bytes, but the file has " + std::to_string(source.bytes.size()) +
                (count > 0 && needed < source.bytes.size()
                     ? ": cut off what follows them, if it is some program's own addition"
                     : ""));
  }
  PolygonSoup soup;
  soup.format = "binary STL";
  soup.place_kind = PlaceKind::Byte;
  NormalCheck normals;
  soup.points.reserve(3 * count);
  soup.corners.reserve(3 * count);
  for (std::size_t facet = 0; facet < count; ++facet) {
    const std::size_t byte = kHeader + kFacet * facet;
    soup.begin_face(static_cast<std::int64_t>(byte));
    for (std::size_t corner = 0; corner < 3; ++corner)
      push_corner(soup, binary_corner(source, byte + 12 * (corner + 1), facet));
    normals.take(binary_vector(source, byte), soup);
  }
  normals.warn(soup);
  weld_equal_points(soup);
  return soup;
}

}  // namespace palpation
