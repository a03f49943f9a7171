/// A line that a caller sent: its members by name and kind, each fault in words.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "palpation/base/types.h"

namespace palpation::tool {

/// What is wrong with a request; the caller's fault, and told to it.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Request {
 public:
  /// Throws BadRequest unless it is an object.
  explicit Request(nlohmann::json line);

  bool has(const std::string& name) const { return line_.contains(name); }
  std::string text(const std::string& name);
  std::string text(const std::string& name, const std::string& otherwise);
  double number(const std::string& name);
  double number(const std::string& name, double otherwise);
  int whole(const std::string& name);
  std::optional<int> whole_or_none(const std::string& name);
  bool truth(const std::string& name, bool otherwise);
  Vec3 triple(const std::string& name);
  Eigen::Vector4d quadruple(const std::string& name);
  std::vector<std::string> texts(const std::string& name);
  /// Throws BadRequest for a member that nobody asked for.
  void done() const;
  /// The caller's own mark, which the answer repeats; null where there is none.
  nlohmann::json mark() const;

 private:
  const nlohmann::json& member(const std::string& name, const char* rule);
  std::vector<double> numbers(const std::string& name, std::size_t count);

  nlohmann::json line_;
  std::set<std::string> asked_{"do", "id"};
};

}  // namespace palpation::tool
