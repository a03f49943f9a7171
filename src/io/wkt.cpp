#include "palpation/io/wkt.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "boundary/outline_repairs.h"
#include "io/mesh_source.h"
#include "io/mesh_text.h"
#include "io/number_text.h"
#include "palpation/base/contract.h"
#include "palpation/io/atomic_file.h"

namespace palpation {
namespace {

constexpr double kFarthest_m = 1e9;  // as Region has it

void append_point(std::string& text, const Vec2& point) {
  text += text_of(point.x()) + " " + text_of(point.y());
}

/// The first point is written again at the end.
void append_ring(std::string& text, const Ring& ring) {
  text += '(';
  for (const Vec2& point : ring) {
    append_point(text, point);
    text += ", ";
  }
  append_point(text, ring.front());
  text += ')';
}

void append_polygon(std::string& text, const PolygonWithHoles& polygon) {
  text += '(';
  append_ring(text, polygon.outer);
  for (const Ring& hole : polygon.holes) append_ring(text += ", ", hole);
  text += ')';
}

/// A polygon and the byte where it begins.
struct PlacedPolygon {
  PolygonWithHoles polygon;
  std::size_t byte = 0;
};

/// The grammar nests three deep at most, so each level is a function of its own and nothing
/// recurses.
class WktParser {
 public:
  explicit WktParser(const MeshSource& source) : source_(source) {}

  std::vector<PlacedPolygon> parse() {
    skip_byte_order_mark();
    const std::size_t start = skip_blanks();
    const std::string_view word = take_word();
    const std::string kind = lower_case(word);
    if (kind != "polygon" && kind != "multipolygon")
      source_.fail_at_byte(start, "POLYGON or MULTIPOLYGON is expected, not " +
                                      (word.empty() ? found() : in_quotes(word)));
    std::vector<PlacedPolygon> polygons;
    if (!take_empty()) {
      if (kind == "polygon") {
        polygons.push_back(polygon());
      } else {
        polygons = all_polygons();
      }
    }
    if (skip_blanks() < source_.bytes.size()) fail("there is text behind the geometry: " + found());
    return polygons;
  }

 private:
  std::vector<PlacedPolygon> all_polygons() {
    std::vector<PlacedPolygon> polygons;
    expect('(');
    do {
      if (!take_empty()) polygons.push_back(polygon());
    } while (take(','));
    expect(')');
    return polygons;
  }

  PlacedPolygon polygon() {
    PlacedPolygon placed{{}, skip_blanks()};
    expect('(');
    placed.polygon.outer = ring();
    while (take(',')) placed.polygon.holes.push_back(ring());
    expect(')');
    return placed;
  }

  Ring ring() {
    Ring ring;
    const std::size_t start = skip_blanks();
    expect('(');
    do {
      const double x = coordinate();
      ring.emplace_back(x, coordinate());
    } while (take(','));
    if (!take(')'))
      fail("\",\" or \")\" is expected behind a point of two coordinates, not " + found());
    if (ring.size() < 4)
      source_.fail_at_byte(start, "a ring of " + std::to_string(ring.size()) +
                                      " points: it has at least 4, the last like the first");
    if (ring.front() != ring.back())
      source_.fail_at_byte(start, "the ring does not end where it began");
    ring.pop_back();
    return ring;
  }

  double coordinate() {
    const std::size_t start = skip_blanks();
    const std::size_t end =
        std::min(source_.bytes.find_first_of(" \t\r\n,()", start), source_.bytes.size());
    const std::string_view word = source_.bytes.substr(start, end - start);
    const ParsedNumber number = parse_number(word);
    if (word.empty()) fail("a number is expected, not " + found());
    if (number.status == NumberStatus::NotANumber) fail(in_quotes(word) + " is not a number");
    if (number.status == NumberStatus::TooLarge || !std::isfinite(number.value))
      fail(in_quotes(word) + " is not finite");
    if (std::abs(number.value) > kFarthest_m)
      fail(in_quotes(word) + " is more than 1e9 m from the origin");
    position_ = end;
    return number.value;
  }

  std::size_t skip_blanks() {
    position_ =
        std::min(source_.bytes.find_first_not_of(" \t\r\n", position_), source_.bytes.size());
    return position_;
  }

  std::string_view take_word() {
    const std::size_t start = skip_blanks();
    while (position_ < source_.bytes.size() && is_letter(source_.bytes[position_])) ++position_;
    return source_.bytes.substr(start, position_ - start);
  }

  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

  bool take_empty() {
    const std::string_view word = take_word();
    if (word.empty()) return false;
    if (lower_case(word) == "empty") return true;
    fail("EMPTY or \"(\" is expected, not " + in_quotes(word) + ": points have two coordinates");
  }

  void skip_byte_order_mark() {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (source_.bytes.substr(0, kMark.size()) == kMark) position_ = kMark.size();
  }

  bool take(char c) {
    const std::size_t at = skip_blanks();
    if (at == source_.bytes.size() || source_.bytes[at] != c) return false;
    ++position_;
    return true;
  }

  void expect(char c) {
    if (!take(c)) fail("\"" + std::string(1, c) + "\" is expected, not " + found());
  }

  /// What stands where something else is expected.
  std::string found() const {
    return position_ >= source_.bytes.size() ? "the end of the file"
                                             : in_quotes(source_.bytes.substr(position_, 20));
  }

  [[noreturn]] void fail(const std::string& what) const { source_.fail_at_byte(position_, what); }

  const MeshSource& source_;
  std::size_t position_ = 0;
};

std::vector<PolygonWithHoles> polygons_of(std::span<const PlacedPolygon> placed) {
  std::vector<PolygonWithHoles> polygons;
  for (const PlacedPolygon& one : placed) polygons.push_back(one.polygon);
  return polygons;
}

std::vector<std::string> warnings_of(const MeshSource& source,
                                     std::span<const PolygonWithHoles> polygons) {
  std::vector<std::string> warnings = repairs_of(polygons).words();
  for (std::string& warning : warnings) warning = source.path.string() + ": " + warning;
  return warnings;
}

/// Says which of the polygons is at fault, if one of them is by itself.
[[noreturn]] void refuse(const MeshSource& source, std::span<const PlacedPolygon> placed,
                         const InvalidInput& error) {
  for (const PlacedPolygon& one : placed) {
    try {
      const Region region(std::span(&one.polygon, 1));
    } catch (const InvalidInput& of_one) {
      source.fail_at_byte(one.byte, rule_words(of_one));
    }
  }
  source.fail(rule_words(error));
}

}  // namespace

std::string to_wkt(const Region& region) {
  const std::vector<PolygonWithHoles> polygons = region.polygons();
  if (polygons.empty()) return "MULTIPOLYGON EMPTY";
  std::string text = "MULTIPOLYGON (";
  for (std::size_t i = 0; i < polygons.size(); ++i)
    append_polygon(i == 0 ? text : text += ", ", polygons[i]);
  return text + ")";
}

BoundaryFile read_wkt(const std::filesystem::path& path) {
  return parse_wkt(read_file(path), path.string());
}

BoundaryFile parse_wkt(const std::string& text, const std::string& name) {
  const MeshSource source{name, text};
  const std::vector<PlacedPolygon> placed = WktParser(source).parse();
  try {
    const std::vector<PolygonWithHoles> polygons = polygons_of(placed);
    const Region region(polygons);
    if (region.empty() && !placed.empty())
      source.fail_at_byte(placed.front().byte,
                          "no area is inside: MULTIPOLYGON EMPTY says so without doubt");
    return {region, warnings_of(source, polygons)};
  } catch (const InvalidInput& error) {
    refuse(source, placed, error);
  }
}

}  // namespace palpation
