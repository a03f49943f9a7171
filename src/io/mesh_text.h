/// Walking through the text of a mesh file: lines (LF, CRLF or CR alone), words, and the
/// coordinates in them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_source.h"
#include "palpation/base/types.h"

namespace palpation {

/// Line by line. Views stay valid as long as the text.
class LineCursor {
 public:
  explicit LineCursor(std::string_view text) : text_(text) {}

  /// The next line without its end, or nothing behind the last.
  std::optional<std::string_view> next();
  std::int64_t line() const { return line_; }  ///< of what next() gave, from 1
  std::size_t position() const { return position_; }
  std::size_t bytes_left() const { return text_.size() - position_; }
  bool ended_without_line_end() const { return open_end_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::int64_t line_ = 0;
  bool open_end_ = false;
};

/// Word by word, across line ends.
class WordCursor {
 public:
  explicit WordCursor(std::string_view text, std::int64_t line = 1) : text_(text), line_(line) {}

  /// The next word, or nothing at the end.
  std::optional<std::string_view> next();
  /// Drops what is left of the line of the last word, and tells it.
  std::string_view skip_line();
  std::int64_t line() const { return line_; }
  std::size_t bytes_left() const { return text_.size() - position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;
};

/// The words of one line, into a vector that is used again. At most `most`: who expects a few need
/// not hold all those of a long line.
void split_words(std::string_view line, std::vector<std::string_view>& words,
                 std::size_t most = std::string_view::npos);

/// The line before its comment: a word that begins with '#', and the rest.
std::string_view without_comment(std::string_view line);

std::string lower_case(std::string_view word);

/// Turns words into finite coordinates, and counts those that were too small for a double.
class CoordinateReader {
 public:
  explicit CoordinateReader(const MeshSource& source) : source_(source) {}

  /// Throws IoError naming line, vertex and component unless the word is a finite number.
  double coordinate(std::string_view word, int component, std::int64_t vertex, std::int64_t line);
  Vec3 point(std::span<const std::string_view, 3> words, std::int64_t vertex, std::int64_t line);
  /// How many were taken as 0.
  std::int64_t underflows() const { return underflows_; }

 private:
  const MeshSource& source_;
  std::int64_t underflows_ = 0;
};

}  // namespace palpation
