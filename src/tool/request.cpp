#include "tool/request.h"

#include <utility>

#include "scene/scene_json.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& name, const json& value, const std::string& rule) {
  throw BadRequest("\"" + name + "\" is " + shown(value) + ", but must be " + rule);
}

}  // namespace

Request::Request(json line) : line_(std::move(line)) {
  if (!line_.is_object())
    throw BadRequest("a request is a JSON object, such as {\"do\": \"next\"}, not " + shown(line_));
}

const json& Request::member(const std::string& name, const char* rule) {
  asked_.insert(name);
  const auto found = line_.find(name);
  if (found == line_.end()) throw BadRequest("\"" + name + "\" is missing: it must be " + rule);
  return *found;
}

std::string Request::text(const std::string& name) {
  const json& value = member(name, "a text");
  if (!value.is_string()) refuse(name, value, "a text");
  std::string text = value.get<std::string>();
  // What a file's name or a message ends at.
  if (text.find('\0') != std::string::npos) refuse(name, value, "a text without NUL");
  return text;
}

std::string Request::text(const std::string& name, const std::string& otherwise) {
  asked_.insert(name);
  return has(name) ? text(name) : otherwise;
}

double Request::number(const std::string& name) {
  const json& value = member(name, "a number");
  if (!value.is_number()) refuse(name, value, "a number");
  return value.get<double>();
}

double Request::number(const std::string& name, double otherwise) {
  asked_.insert(name);
  return has(name) ? number(name) : otherwise;
}

int Request::whole(const std::string& name) {
  const double value = number(name);
  if (!(std::abs(value) <= 1e9) || value != std::floor(value))
    refuse(name, line_.at(name), "a whole number");
  return static_cast<int>(value);
}

std::optional<int> Request::whole_or_none(const std::string& name) {
  asked_.insert(name);
  return has(name) ? std::optional(whole(name)) : std::nullopt;
}

bool Request::truth(const std::string& name, bool otherwise) {
  asked_.insert(name);
  if (!has(name)) return otherwise;
  if (!line_.at(name).is_boolean()) refuse(name, line_.at(name), "true or false");
  return line_.at(name).get<bool>();
}

std::vector<double> Request::numbers(const std::string& name, std::size_t count) {
  const std::string rule = "a list of " + std::to_string(count) + " numbers";
  const json& value = member(name, rule.c_str());
  if (!value.is_array() || value.size() != count) refuse(name, value, rule);
  std::vector<double> numbers;
  for (const json& one : value) {
    if (!one.is_number()) refuse(name, value, rule);
    numbers.push_back(one.get<double>());
  }
  return numbers;
}

Vec3 Request::triple(const std::string& name) {
  const std::vector<double> values = numbers(name, 3);
  return Vec3(values[0], values[1], values[2]);
}

Eigen::Vector4d Request::quadruple(const std::string& name) {
  const std::vector<double> values = numbers(name, 4);
  return Eigen::Vector4d(values[0], values[1], values[2], values[3]);
}

std::vector<std::string> Request::texts(const std::string& name) {
  asked_.insert(name);
  if (!has(name)) return {};
  const json& value = line_.at(name);
  std::vector<std::string> texts;
  if (!value.is_array()) refuse(name, value, "a list of texts");
  for (const json& one : value) {
    if (!one.is_string()) refuse(name, value, "a list of texts");
    texts.push_back(one.get<std::string>());
  }
  return texts;
}

void Request::done() const {
  for (const auto& [name, value] : line_.items()) {
    if (!asked_.contains(name)) throw BadRequest("\"" + shown_key(name) + "\" means nothing here");
  }
}

json Request::mark() const {
  const auto found = line_.find("id");
  return found == line_.end() ? json() : *found;
}

}  // namespace palpation::tool
