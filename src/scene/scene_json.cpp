#include "scene/scene_json.h"

#include <algorithm>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr std::size_t kMostDepth = 32;
constexpr std::uintmax_t kMostBytes = 16u << 20;
constexpr std::size_t kLongest = 60;

std::string cut(std::string text) {
  if (text.size() <= kLongest) return text;
  return text.substr(0, kLongest) + "...";
}

/// What is no printable ASCII becomes a question mark.
std::string printable(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < 0x20 || c == 0x7f; }, '?');
  return result;
}

/// "line:column" of a byte, both from 1.
std::string place_in(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const std::size_t line =
      static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  const std::size_t start = before.rfind('\n');
  const std::size_t column =
      start == std::string_view::npos ? before.size() : before.size() - start - 1;
  return std::to_string(line) + ":" + std::to_string(std::max<std::size_t>(column, 1));
}

/// Builds the value event by event, and knows the key at which it is.
class SceneReader : public json::json_sax_t {
 public:
  SceneReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(value); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    open_.back().key = name;
    if (open_.back().value->contains(name))
      throw IoError(name_ + ": " + path() + ": appears twice");
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const std::string start = name_ + ":" + place_in(text_, byte) + ": ";
    const std::string words = error.what();  // "[json.exception.parse_error.101] parse error at
                                             // line 3, column 5: syntax error ..."
    if (error.id == 406)
      throw NumberTooLarge(start + cut(printable(words.substr(words.rfind(' ') + 1))) +
                           " is too large for a double");
    const std::size_t rule = words.find(": ");
    throw IoError(start + "not JSON: " +
                  printable(words.substr(rule == std::string::npos ? 0 : rule + 2, 3 * kLongest)));
  }

 private:
  struct Open {
    json* value;
    std::string key{};
  };

  json* place(json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    json& parent = *open_.back().value;
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    return &(parent[open_.back().key] = std::move(value));
  }

  bool put(json value) {
    place(std::move(value));
    return true;
  }

  bool open(json value) {
    if (open_.size() == kMostDepth)
      throw IoError(name_ + ": " + shown_key(path()) + ": is nested deeper than " +
                    std::to_string(kMostDepth) + " levels, which no scene needs");
    open_.push_back({place(std::move(value))});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::string path() const {
    std::string path;
    for (const Open& one : open_) {
      if (one.value->is_array()) {
        path += "[" + std::to_string(one.value->empty() ? 0 : one.value->size() - 1) + "]";
      } else {
        path += (path.empty() ? "" : ".") + shown_key(one.key);
      }
    }
    return path;
  }

  std::string_view text_;
  const std::string& name_;
  json root_;
  std::vector<Open> open_;
};

}  // namespace

json parse_json(std::string_view text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw IoError(name + ": is empty; a scene is a JSON object, such as { \"version\": 1, ... }");
  SceneReader reader(text, name);
  json::sax_parse(text, &reader);
  // To the parser a NUL is the end: what follows it would be dropped without a word.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    throw IoError(name + ":" + place_in(text, nul + 1) + ": not JSON: a NUL byte (if this is " +
                  "UTF-16, save it as UTF-8)");
  return reader.take();
}

json read_json(const std::filesystem::path& path) {
  return parse_json(read_file(path, kMostBytes), path.string());
}

std::string shown(const json& value) {
  if (value.is_structured() && value.size() > kLongest)
    return value.is_array() ? "a long list" : "a large object";
  return cut(value.dump(-1, ' ', true, json::error_handler_t::replace));
}

std::string shown_key(std::string_view key) { return cut(printable(key.substr(0, 2 * kLongest))); }

}  // namespace palpation::tool
