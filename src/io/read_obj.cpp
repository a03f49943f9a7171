#include <algorithm>
#include <limits>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/polygon_soup.h"

namespace palpation {
namespace {

/// Statements that carry no geometry of their own: names, materials (whose files are never opened),
/// texture, what free-form geometry needs.
constexpr std::array kIgnored = {
    "vt",       "vn",     "vp",   "g",      "o",      "s",          "mg",        "usemtl",
    "mtllib",   "usemap", "lod",  "maplib", "bevel",  "shadow_obj", "trace_obj", "c_interp",
    "d_interp", "deg",    "bmat", "step",   "cstype", "parm",       "trim",      "hole",
    "scrv",     "sp",     "end",  "con",    "ctech",  "stech",      "res"};
/// What names another file whose statements were to stand here: the mesh would lack them.
constexpr std::array kCalling = {"call", "csh"};
/// Geometry that is not made of faces.
constexpr std::array kLeftOut = {"p", "l", "curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp"};
/// x, y, z; a weight, or a colour of up to four numbers.
constexpr std::size_t kMostNumbersOfVertex = 8;

bool is_among(std::span<const char* const> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Of a comment that may tell counts.
constexpr std::size_t kMostWordsOfComment = 16;

/// Those of them that take names, of things or of files.
constexpr std::array kNaming = {"g",      "o",      "s",      "usemtl",     "mtllib",
                                "usemap", "maplib", "newmtl", "shadow_obj", "trace_obj"};

class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source)
      : source_(source), lines_(source.bytes), coordinates_(source) {
    soup_.format = "OBJ";
    soup_.place_kind = PlaceKind::Line;
    soup_.first_number = 1;
  }

  PolygonSoup read() {
    source_.refuse_nul_bytes();
    while (const std::optional<std::string_view> statement = next_statement()) {
      // A word more than a face may have, so that it is seen that it has too many.
      split_words(without_comment(*statement), words_, kMostCorners + 2);
      if (words_.empty()) {
        take_comment(*statement);
      } else {
        take_statement();
      }
    }
    warn();
    return std::move(soup_);
  }

 private:
  /// The next line, joined with those that follow a backslash at its end. Comments and names never
  /// go on: they may end with the path of a folder.
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
    if (line.empty() || line.back() != '\\') return false;
    const std::size_t first = line.find_first_not_of(" \t");
    const std::string_view word = line.substr(first, line.find_first_of(" \t", first) - first);
    return word[0] != '#' && !is_among(kNaming, word);
  }

  /// In front of all statements many programs say how much will follow, as "# Vertices: 8" or "# 8
  /// vertices, 12 faces": the only counts that an OBJ file has.
  void take_comment(std::string_view line) {
    if (!in_preamble_) return;
    split_words(line.substr(std::min(line.find_first_not_of("# \t"), line.size())), words_,
                kMostWordsOfComment);
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::string word =
          lower_case(words_[i].substr(0, words_[i].find_last_not_of(":,.") + 1));
      std::optional<std::int64_t>* count = word == "vertices" ? &announced_vertices_
                                           : word == "faces"  ? &announced_faces_
                                                              : nullptr;
      if (count == nullptr) continue;
      const bool number_follows = words_[i].back() == ':' && i + 1 < words_.size();
      if (number_follows || i > 0) *count = parse_integer(words_[number_follows ? i + 1 : i - 1]);
    }
  }

  void take_statement() {
    in_preamble_ = false;
    if (words_[0] == "v") {
      take_vertex();
    } else if (words_[0] == "f" || words_[0] == "fo") {
      take_face();
    } else if (is_among(kLeftOut, words_[0])) {
      ++left_out_;
    } else if (is_among(kCalling, words_[0])) {
      source_.fail_at_line(line_, in_quotes(words_[0]) +
                                      " runs another file, which is not read: export the mesh as "
                                      "one file, without it");
    } else if (!is_among(kIgnored, words_[0])) {
      source_.fail_at_line(line_, in_quotes(words_[0]) + " is no statement of an OBJ file");
    }
  }

  void warn() {
    soup_.warn_of_underflows(coordinates_.underflows());
    if (left_out_ > 0)
      soup_.warn(std::to_string(left_out_) + " points, lines or free forms were left out.",
                 kFacesOnly);
    if (lines_.ended_without_line_end())
      soup_.warn("The last line has no line end: the file may have been cut short.", kFreshCopy);
    const auto compare = [&](std::optional<std::int64_t> announced, std::size_t found,
                             const std::string& what) {
      if (!announced || *announced == static_cast<std::int64_t>(found)) return;
      soup_.warn("A comment at the top says " + std::to_string(*announced) + " " + what +
                     ", but there are " + std::to_string(found) + ": the file may be damaged.",
                 kFreshCopy);
    };
    compare(announced_vertices_, soup_.points.size(), "vertices");
    compare(announced_faces_, soup_.face_count(), "faces");
  }

  void take_vertex() {
    const auto number = static_cast<std::int64_t>(soup_.points.size()) + 1;
    if (words_.size() < 4) {
      source_.fail_at_line(line_, "vertex " + std::to_string(number) + " has " +
                                      std::to_string(words_.size() - 1) + " coordinates, not 3");
    }
    soup_.points.push_back(coordinates_.point(
        std::span<const std::string_view, 3>(words_.data() + 1, 3), number, line_));
    check_numbers_behind(number);
  }

  /// They are of no use here, but what is no number may be the next line, its end lost.
  void check_numbers_behind(std::int64_t vertex) const {
    if (words_.size() > kMostNumbersOfVertex + 1) {
      source_.fail_at_line(line_, "vertex " + std::to_string(vertex) + " has more than " +
                                      std::to_string(kMostNumbersOfVertex) + " numbers");
    }
    for (std::size_t i = 4; i < words_.size(); ++i) {
      if (parse_number(words_[i]).status == NumberStatus::NotANumber)
        source_.fail_at_line(line_, "vertex " + std::to_string(vertex) + ": " +
                                        in_quotes(words_[i]) +
                                        " behind its coordinates is no number");
    }
  }

  void take_face() {
    soup_.begin_face(line_);
    for (std::size_t i = 1; i < words_.size(); ++i) soup_.corners.push_back(vertex_of(words_[i]));
    soup_.end_face(source_);
  }

  /// "7", "7/1", "7//3", "7/1/3": the index before the first slash.
  int vertex_of(std::string_view word) const {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::optional<std::int64_t> index = parse_integer(word.substr(0, slash));
    if (!index || !is_reference(word.substr(slash)))
      fail_at_corner(word, "is not of the form vertex/texture/normal, in whole numbers that fit");
    if (*index == 0) fail_at_corner(word, "has the vertex index 0; they count from 1");
    const auto count = static_cast<std::int64_t>(soup_.points.size());
    if (*index < -count)
      fail_at_corner(word, "counts back beyond the first of the " + std::to_string(count) +
                               " vertices so far");
    // Indices ahead of the vertices read so far are legal: triangles_of checks them against all of
    // them.
    if (*index > std::numeric_limits<int>::max())
      fail_at_corner(word, "is out of range: more than 2^31 - 1");
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
    source_.fail_at_line(line_, "face " + std::to_string(soup_.face_count()) + ": corner " +
                                    in_quotes(word) + " " + rule);
  }

  const MeshSource& source_;
  LineCursor lines_;
  CoordinateReader coordinates_;
  PolygonSoup soup_;
  std::vector<std::string_view> words_;
  std::string joined_;
  std::int64_t line_ = 0;
  std::int64_t left_out_ = 0;
  std::optional<std::int64_t> announced_vertices_, announced_faces_;
  bool in_preamble_ = true;
};

}  // namespace

PolygonSoup read_obj(const MeshSource& source) { return ObjReader(source).read(); }

}  // namespace palpation
