#include <algorithm>
#include <limits>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/polygon_soup.h"

namespace palpation {
namespace {

/// Statements that carry no triangles: names, materials (whose files are never opened), texture, free-form geometry.
constexpr std::array kIgnored = {"vt",       "vn",     "vp",     "g",      "o",      "s",     "l",          "p",         "mg",
                                 "usemtl",   "mtllib", "usemap", "maplib", "lod",    "bevel", "shadow_obj", "trace_obj", "c_interp",
                                 "d_interp", "deg",    "bmat",   "step",   "cstype", "curv",  "curv2",      "surf",      "parm",
                                 "trim",     "hole",   "scrv",   "sp",     "end",    "con",   "call",       "csh",       "ctech",
                                 "stech",    "bzp",    "bsp",    "cdc",    "cdp",    "res"};

class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source) : source_(source), lines_(source.bytes), coordinates_(source) {
    soup_.format = "OBJ";
    soup_.place_kind = PlaceKind::Line;
    soup_.first_number = 1;
  }

  PolygonSoup read() {
    source_.refuse_nul_bytes();
    while (const std::optional<std::string_view> statement = next_statement()) {
      split_words(without_comment(*statement), words_);
      if (!words_.empty()) take_statement();
    }
    coordinates_.warn(soup_.warnings);
    if (last_was_face_ && lines_.ended_without_line_end()) {
      soup_.warnings.push_back("The last line, a face, has no line end: the file may have been cut short.");
    }
    return std::move(soup_);
  }

 private:
  /// The next line, joined with those that follow a backslash at its end. A comment never goes on: it may end with the path of a folder.
  std::optional<std::string_view> next_statement() {
    std::optional<std::string_view> line = lines_.next();
    line_ = lines_.line();
    if (!line || !continues(*line)) return line;
    joined_.clear();
    while (line && continues(*line)) {
      joined_.append(line->substr(0, line->size() - 1)).append(" ");
      line = lines_.next();
    }
    if (!line) source_.fail_at_line(line_, "a backslash promises another line, but the file ends");
    joined_.append(*line);
    return joined_;
  }

  static bool continues(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return !line.empty() && line.back() == '\\' && line[first] != '#';
  }

  void take_statement() {
    last_was_face_ = false;
    if (words_[0] == "v") {
      take_vertex();
    } else if (words_[0] == "f" || words_[0] == "fo") {
      take_face();
      last_was_face_ = true;
    } else if (std::find(kIgnored.begin(), kIgnored.end(), words_[0]) == kIgnored.end()) {
      source_.fail_at_line(line_, in_quotes(words_[0]) + " is no statement of an OBJ file");
    }
  }

  void take_vertex() {
    const auto number = static_cast<std::int64_t>(soup_.points.size()) + 1;
    if (words_.size() < 4) {
      source_.fail_at_line(line_, "vertex " + std::to_string(number) + " has " + std::to_string(words_.size() - 1) + " coordinates, not 3");
    }
    soup_.points.push_back(coordinates_.point(std::span<const std::string_view, 3>(words_.data() + 1, 3), number, line_));
  }

  void take_face() {
    soup_.begin_face(line_);
    for (std::size_t i = 1; i < words_.size(); ++i) soup_.corners.push_back(vertex_of(words_[i]));
  }

  /// "7", "7/1", "7//3", "7/1/3": the index before the first slash.
  int vertex_of(std::string_view word) const {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::optional<std::int64_t> index = parse_integer(word.substr(0, slash));
    if (!index || !is_reference(word.substr(slash)))
      fail_at_corner(word, "is not of the form vertex/texture/normal, in whole numbers that fit");
    if (*index == 0) fail_at_corner(word, "has the vertex index 0; they count from 1");
    const auto count = static_cast<std::int64_t>(soup_.points.size());
    if (*index < -count) fail_at_corner(word, "counts back beyond the first of the " + std::to_string(count) + " vertices so far");
    // Indices ahead of the vertices read so far are legal: triangles_of checks them against all of them.
    if (*index > std::numeric_limits<int>::max()) fail_at_corner(word, "is out of range: more than 2^31 - 1");
    return static_cast<int>(*index > 0 ? *index - 1 : count + *index);
  }

  /// What may follow the vertex: at most two slashes, each before a whole number or nothing.
  static bool is_reference(std::string_view rest) {
    for (int slashes = 0; !rest.empty(); ++slashes) {
      if (slashes == 2) return false;
      rest.remove_prefix(1);
      const std::size_t end = std::min(rest.find('/'), rest.size());
      if (end > 0 && !parse_integer(rest.substr(0, end))) return false;
      rest.remove_prefix(end);
    }
    return true;
  }

  [[noreturn]] void fail_at_corner(std::string_view word, const std::string& rule) const {
    source_.fail_at_line(line_, "face " + std::to_string(soup_.face_count()) + ": corner " + in_quotes(word) + " " + rule);
  }

  const MeshSource& source_;
  LineCursor lines_;
  CoordinateReader coordinates_;
  PolygonSoup soup_;
  std::vector<std::string_view> words_;
  std::string joined_;
  std::int64_t line_ = 0;
  bool last_was_face_ = false;
};

}  // namespace

PolygonSoup read_obj(const MeshSource& source) { return ObjReader(source).read(); }

}  // namespace palpation
