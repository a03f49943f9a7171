#include "tool/man_page.h"

#include <string_view>

#include "scene/scene_schema.h"

namespace palpation::tool {
namespace {

/// As man's macros take text: hyphens that can be copied, and nothing at the start of a line that
/// is a macro.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins = result.empty() || result.back() == '\n';
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (!(begins && c == ' '))
      result += c;
  }
  return result;
}

void add_item(std::string& page, const std::string& name, const std::string& words) {
  page += ".TP\n\\fB" + plain(name) + "\\fR\n" + plain(words) + "\n";
}

std::string usage_of(const CLI::App& command, const std::string& before) {
  std::string usage = before + " " + command.get_name();
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name();
    usage += option->get_required() ? " " + name : " [" + name + "]";
  }
  return usage;
}

void add_command(std::string& page, const CLI::App& command, const std::string& before) {
  page +=
      ".SS " + plain(usage_of(command, before)) + "\n" + plain(command.get_description()) + "\n";
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name(false, true).find("--help") != std::string::npos) continue;
    const std::string type = option->get_positional() || option->get_items_expected_max() == 0
                                 ? ""
                                 : " " + option->get_type_name();
    add_item(page,
             option->get_positional() ? option->get_name() : option->get_name(false, true) + type,
             option->get_description());
  }
  for (const CLI::App* inner : command.get_subcommands({}))
    add_command(page, *inner, before + " " + command.get_name());
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string page =
      ".TH PALPATE 1\n.SH NAME\npalpate \\- where to touch tissue next, and where the tumour under "
      "it ends\n.SH SYNOPSIS\n\\fBpalpate\\fR COMMAND [OPTIONS]\n.SH DESCRIPTION\n" +
      plain(app.get_description()) +
      "\nIt is for research on phantoms and excised tissue, not for patients.\n.SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({})) add_command(page, *command, "palpate");
  page +=
      ".SH THE KEYS OF A SCENE\nA scene is a JSON file; surface.mesh is \"surface\": "
      "{ \"mesh\": ... } there.\n";
  for (const SceneKey& key : scene_keys()) {
    const std::string unit = key.unit.empty() ? "" : " [" + key.unit + "]";
    const std::string standard = key.standard.is_null() ? "" : "; default " + key.standard.dump();
    add_item(page, key.path + unit, key.meaning + standard);
  }
  page += ".SH EXIT STATUS\n";
  add_item(page, "0", "done");
  add_item(page, "2", "wrong usage");
  add_item(page, "3", "something that was given is at fault: a file, a scene, a table");
  add_item(page, "4", "the machine or the arithmetic failed");
  add_item(page, "130", "interrupted");
  return page;
}

}  // namespace palpation::tool
