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

/// The words lead through subcommands to one; null where they do not.
const CLI::App* command_called(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* here = &app;
  for (const std::string& word : words) {
    const auto inner = here->get_subcommands([](const CLI::App*) { return true; });
    const auto found =
        std::ranges::find(inner, word, [](const CLI::App* one) { return one->get_name(); });
    if (found == inner.end()) return nullptr;
    here = *found;
  }
  return here;
}

std::string command_help(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = command_called(app, words);
  if (command == nullptr) return "";
  std::string before = "palpate";
  for (std::size_t i = 0; i + 1 < words.size(); ++i) before += " " + words[i];
  return command->help(before);
}

std::string about(const CLI::App& app, const std::vector<std::string>& topic) {
  const std::string words = joined(topic);
  if (words.empty()) return app.help();
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
