#include <limits>

#include "io/mesh_text.h"
#include "io/number_text.h"
#include "io/polygon_soup.h"

namespace palpation {
namespace {

/// What may follow the coordinates of a vertex (normal, colour, texture), and the corners of a face
/// (colour).
constexpr std::size_t kMostBehindVertex = 12;
constexpr std::size_t kMostBehindFace = 4;

/// Line by line: a header, the counts (on its line or the next), a line for each vertex and each
/// face. What follows the coordinates or the corners is ignored, so long as it is numbers.
class OffReader {
 public:
  explicit OffReader(const MeshSource& source)
      : source_(source), lines_(source.bytes), coordinates_(source) {
    soup_.format = "OFF";
    soup_.place_kind = PlaceKind::Line;
  }

  PolygonSoup read() {
    read_header();
    source_.refuse_nul_bytes();
    for (std::int64_t vertex = 0; vertex < vertex_count_; ++vertex) read_vertex(vertex);
    for (std::int64_t face = 0; face < face_count_; ++face) read_face(face);
    if (next_words())
      source_.fail_at_line(lines_.line(), "more lines than the header's counts announce");
    soup_.warn_of_underflows(coordinates_.underflows());
    return std::move(soup_);
  }

 private:
  /// Splits the next line that holds anything; false at the end.
  bool next_words() {
    while (const std::optional<std::string_view> line = lines_.next()) {
      // A word more than a face may have, so that it is seen that it has too many.
      split_words(without_comment(*line), words_, kMostCorners + kMostBehindVertex + 2);
      if (!words_.empty()) return true;
    }
    return false;
  }

  void expect_words(const std::string& what) {
    if (!next_words())
      source_.fail_at_byte(source_.bytes.size(), "the file ends where " + what + " is expected");
  }

  void read_header() {
    expect_words("the word OFF");
    const std::string_view kind = words_[0];
    if (kind.find("4") != std::string_view::npos || kind.find("n") != std::string_view::npos) {
      source_.fail_at_line(lines_.line(),
                           in_quotes(kind) + ": only OFF files with three coordinates are read");
    }
    words_.erase(words_.begin());
    if (words_.empty()) expect_words("the line of the counts");
    if (words_[0] == "BINARY")
      source_.fail_at_line(lines_.line(), "binary OFF is not read: write it as ASCII, or as PLY");
    if (words_.size() < 2)
      source_.fail_at_line(lines_.line(), "the counts of vertices and faces are expected");
    if (words_.size() > 3)
      source_.fail_at_line(lines_.line(),
                           "more than three counts: every vertex and every face has its own line");
    const std::int64_t line = lines_.line();
    // The shortest records are "0 0 0" and "3 0 1 2" (a face with fewer corners is an error); the
    // last line end may be missing.
    const auto bytes = static_cast<std::int64_t>(lines_.bytes_left()) + 1;
    vertex_count_ = count_of(words_[0], "vertices", bytes / 6, line);
    face_count_ = count_of(words_[1], "faces", bytes / 2, line);
    if (words_.size() == 3)
      count_of(words_[2], "edges", std::numeric_limits<std::int64_t>::max(), line);
    soup_.points.reserve(vertex_count_);
  }

  std::int64_t count_of(std::string_view word, const std::string& what, std::int64_t most,
                        std::int64_t line) const {
    const std::optional<std::int64_t> count = parse_integer(word);
    if (!count || *count < 0)
      source_.fail_at_line(line, in_quotes(word) + " is not a count of " + what);
    if (*count > most) {
      source_.fail_at_line(line, std::to_string(*count) + " " + what + " do not fit into the " +
                                     std::to_string(lines_.bytes_left()) + " bytes that follow");
    }
    return *count;
  }

  void read_vertex(std::int64_t vertex) {
    expect_words("vertex " + std::to_string(vertex));
    if (words_.size() < 3) {
      source_.fail_at_line(lines_.line(), "vertex " + std::to_string(vertex) + " has " +
                                              std::to_string(words_.size()) +
                                              " coordinates, not 3");
    }
    soup_.points.push_back(coordinates_.point(
        std::span<const std::string_view, 3>(words_.data(), 3), vertex, lines_.line()));
    check_numbers_behind(3, kMostBehindVertex, "vertex " + std::to_string(vertex));
    if (vertex == 0) numbers_of_vertex_ = words_.size();
    if (words_.size() == numbers_of_vertex_) return;
    source_.fail_at_line(lines_.line(), "vertex " + std::to_string(vertex) + " has " +
                                            std::to_string(words_.size()) +
                                            " numbers, but those before it have " +
                                            std::to_string(numbers_of_vertex_));
  }

  /// They are of no use here, but what is no number may be the next line, its end lost.
  void check_numbers_behind(std::size_t first, std::size_t most, const std::string& element) const {
    if (words_.size() > first + most)
      source_.fail_at_line(
          lines_.line(), element + " has more than " + std::to_string(most) + " numbers too many");
    for (std::size_t i = first; i < words_.size(); ++i) {
      if (parse_number(words_[i]).status == NumberStatus::NotANumber)
        source_.fail_at_line(lines_.line(), element + ": " + in_quotes(words_[i]) +
                                                " at the end of its line is no number");
    }
  }

  void read_face(std::int64_t face) {
    expect_words("face " + std::to_string(face));
    const std::string name = "face " + std::to_string(face) + ": ";
    const std::optional<std::int64_t> count = parse_integer(words_[0]);
    if (!count || *count < 0)
      source_.fail_at_line(lines_.line(),
                           name + in_quotes(words_[0]) + " is not a count of corners");
    if (*count > kMostCorners)
      source_.fail_at_line(lines_.line(), name + std::to_string(*count) + " corners; at most " +
                                              std::to_string(kMostCorners) + " are taken");
    if (*count > static_cast<std::int64_t>(words_.size()) - 1) {
      source_.fail_at_line(lines_.line(), name + std::to_string(*count) + " corners announced, " +
                                              std::to_string(words_.size() - 1) + " there");
    }
    soup_.begin_face(lines_.line());
    for (std::int64_t i = 1; i <= *count; ++i) {
      const std::string_view word = words_[i];
      const std::optional<std::int64_t> index = parse_integer(word);
      if (!index || *index < 0 || *index >= vertex_count_) {
        source_.fail_at_line(lines_.line(), name + "vertex index " + in_quotes(word) +
                                                " is out of range 0 to " +
                                                std::to_string(vertex_count_ - 1));
      }
      soup_.corners.push_back(static_cast<int>(*index));
    }
    soup_.end_face(source_);
    check_numbers_behind(static_cast<std::size_t>(*count) + 1, kMostBehindFace,
                         "face " + std::to_string(face));
  }

  const MeshSource& source_;
  LineCursor lines_;
  CoordinateReader coordinates_;
  PolygonSoup soup_;
  std::vector<std::string_view> words_;
  std::int64_t vertex_count_ = 0, face_count_ = 0;
  std::size_t numbers_of_vertex_ = 0;
};

}  // namespace

PolygonSoup read_off(const MeshSource& source) { return OffReader(source).read(); }

}  // namespace palpation
