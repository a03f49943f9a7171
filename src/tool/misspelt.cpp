#include "tool/misspelt.h"

#include <vector>

#include "scene/edit_distance.h"

namespace palpation::tool {
namespace {

/// What is spelt most like it; empty where more than half of its letters differ.
std::string nearest_of(const std::string& word, const std::vector<std::string>& names) {
  std::string nearest;
  int least = static_cast<int>(word.size()) / 2;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    if (distance > least || (distance == least && !nearest.empty())) continue;
    nearest = name;
    least = distance;
  }
  return nearest;
}

std::vector<std::string> commands_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* one : command.get_subcommands({})) names.push_back(one->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::string misspelt_words(const CLI::App& app) {
  const CLI::App* command = &app;
  std::string called = "palpate";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    called += " " + command->get_name();
  }
  std::string lines;
  bool may_be_command = command->get_require_subcommand_min() > 0;
  for (const std::string& given : app.remaining(true)) {
    const std::string word = given.substr(0, given.find('='));
    const bool is_option = word.starts_with("--");
    if (!is_option && !may_be_command) continue;
    if (!is_option) may_be_command = false;
    const std::string nearest =
        nearest_of(word, is_option ? options_of(*command) : commands_of(*command));
    lines += called + ": there is no " + (is_option ? "option " : "command ") + word +
             (nearest.empty() ? "" : "; the nearest is " + nearest) + "\n";
  }
  return lines;
}

}  // namespace palpation::tool
