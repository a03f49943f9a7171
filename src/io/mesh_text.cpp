#include "io/mesh_text.h"

#include <cmath>

#include "io/number_text.h"

namespace palpation {
namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Length of the line end at a position that holds one: CRLF is a single end.
std::size_t line_end_length(std::string_view text, std::size_t position) {
  return text[position] == '\r' && position + 1 < text.size() && text[position + 1] == '\n' ? 2 : 1;
}

}  // namespace

std::optional<std::string_view> LineCursor::next() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t first = position_;
  while (position_ < text_.size() && !is_line_end(text_[position_])) ++position_;
  const std::string_view line = text_.substr(first, position_ - first);
  open_end_ = position_ == text_.size();
  if (!open_end_) position_ += line_end_length(text_, position_);
  ++line_;
  return line;
}

std::optional<std::string_view> WordCursor::next() {
  while (position_ < text_.size() &&
         (is_blank(text_[position_]) || is_line_end(text_[position_]))) {
    if (!is_line_end(text_[position_])) {
      ++position_;
      continue;
    }
    position_ += line_end_length(text_, position_);
    ++line_;
  }
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t first = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && !is_line_end(text_[position_]))
    ++position_;
  return text_.substr(first, position_ - first);
}

std::string_view WordCursor::skip_line() {
  const std::size_t first = position_;
  while (position_ < text_.size() && !is_line_end(text_[position_])) ++position_;
  return text_.substr(first, position_ - first);
}

void split_words(std::string_view line, std::vector<std::string_view>& words, std::size_t most) {
  words.clear();
  std::size_t position = 0;
  while (position < line.size() && words.size() < most) {
    while (position < line.size() && is_blank(line[position])) ++position;
    const std::size_t first = position;
    while (position < line.size() && !is_blank(line[position])) ++position;
    if (position > first) words.push_back(line.substr(first, position - first));
  }
}

std::string_view without_comment(std::string_view line) {
  std::size_t mark = line.find('#');
  while (mark != std::string_view::npos && mark > 0 && !is_blank(line[mark - 1]))
    mark = line.find('#', mark + 1);
  return line.substr(0, mark);
}

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

double CoordinateReader::coordinate(std::string_view word, int component, std::int64_t vertex,
                                    std::int64_t line) {
  const ParsedNumber number = parse_number(word);
  const auto fail = [&](const std::string& rule) {
    source_.fail_at_line(line, "vertex " + std::to_string(vertex) + ": " + "xyz"[component] +
                                   " = " + in_quotes(word) + " " + rule);
  };
  if (number.status == NumberStatus::NotANumber) fail("is not a number (decimal point, no units)");
  if (number.status == NumberStatus::TooLarge) fail("is too large for a double");
  if (!std::isfinite(number.value)) fail("is not finite");
  if (number.status == NumberStatus::Underflow) ++underflows_;
  return number.value;
}

Vec3 CoordinateReader::point(std::span<const std::string_view, 3> words, std::int64_t vertex,
                             std::int64_t line) {
  Vec3 point;
  for (int component = 0; component < 3; ++component) {
    point[component] = coordinate(words[component], component, vertex, line);
  }
  return point;
}

}  // namespace palpation
