#include "tool/help_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "scene/exit_code.h"
#include "scene/scene_schema.h"
#include "tool/completion.h"
#include "tool/man_page.h"

namespace palpation::tool {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Whether a command takes that word as its first, of those that it lists: plane of mesh.
bool takes(const CLI::App& command, const std::string& word) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string listed = option->get_type_name();  // TEXT:{plane,dome}
    const auto begin = listed.find('{'), end = listed.find('}');
    if (begin == std::string::npos || end == std::string::npos) return false;
    return ("," + listed.substr(begin + 1, end - begin - 1) + ",").find("," + word + ",") !=
           std::string::npos;
  }
  return false;
}

/// The words lead through subcommands to one, of which the last may be a word that it takes; null
/// where they do not. `depth` is how many of them are commands.
const CLI::App* command_called(const CLI::App& app, const std::vector<std::string>& words,
                               std::size_t& depth) {
  const CLI::App* here = &app;
  for (depth = 0; depth < words.size(); ++depth) {
    const auto inner = here->get_subcommands([](const CLI::App*) { return true; });
    const auto found =
        std::ranges::find(inner, words[depth], [](const CLI::App* one) { return one->get_name(); });
    if (found == inner.end())
      return depth > 0 && depth + 1 == words.size() && takes(*here, words[depth]) ? here : nullptr;
    here = *found;
  }
  return here;
}

std::string command_help(const CLI::App& app, const std::vector<std::string>& words) {
  std::size_t depth = 0;
  const CLI::App* command = command_called(app, words, depth);
  if (command == nullptr) return "";
  std::string before = "palpate";
  for (std::size_t i = 0; i + 1 < depth; ++i) before += " " + words[i];
  return command->help(before);
}

/// Of the program: `app.help()` would be that of the command which is running, this one.
std::string program_help(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, "palpate", CLI::AppFormatMode::Normal);
}

std::string about(const CLI::App& app, const std::vector<std::string>& topic) {
  const std::string words = joined(topic);
  if (words.empty()) return program_help(app);
  if (words == "scene") return scene_help();
  if (words == "man") return man_page(app);
  if (words == "completion") return completion(app);
  std::string text = command_help(app, topic);
  if (text.empty() && topic.size() == 1) text = key_help(words);
  if (text.empty())
    throw WrongUsage("help: there is no command and no key '" + words +
                     "': palpate --help lists the commands, palpate help scene the keys; the "
                     "nearest key is " +
                     nearest_key(words, scene_keys()));
  return text;
}

}  // namespace

void add_help_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("help", "Explain a command, or the keys of a scene: palpate help scene");
  const auto topic = std::make_shared<std::vector<std::string>>();
  command->add_option("TOPIC", *topic,
                      "a command; scene; a key, such as field.metric, or a group, such as robot; "
                      "man: all as a manual page; completion: for bash");
  command->callback([&app, topic] { std::fputs(about(app, *topic).c_str(), stdout); });
}

}  // namespace palpation::tool
