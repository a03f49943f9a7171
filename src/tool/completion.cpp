#include "tool/completion.h"

#include "scene/scene_schema.h"

namespace palpation::tool {
namespace {

constexpr const char* kScript =
    R"(# Completion of palpate for bash: made by `palpate help completion`.
_palpate() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command="" word i
  local keys="@keys@"
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    case " @paths@ " in
      *" ${command:+$command/}$word "*) command=${command:+$command/}$word ;;
    esac
  done
  local words=""
  case $command in
@cases@  esac
  COMPREPLY=()
  if [[ $previous == --set ]]; then
    compopt -o nospace 2>/dev/null
    COMPREPLY=($(compgen -S = -W "$keys" -- "$current"))
  elif [[ $command == help ]]; then
    COMPREPLY=($(compgen -W "scene man completion $keys @commands@" -- "$current"))
  elif [[ -z $command || $command == mesh || $current == -* ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  fi
}
complete -o default -F _palpate palpate
)";

void replace(std::string& text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

/// What may follow a command: its subcommands and its options.
void add_case(std::string& cases, std::string& paths, const CLI::App& command,
              const std::string& path) {
  std::string words;
  for (const CLI::App* inner : command.get_subcommands({})) words += inner->get_name() + " ";
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  }
  cases += "    \"" + path + "\") words=\"" + words + "\" ;;\n";
  for (const CLI::App* inner : command.get_subcommands({})) {
    const std::string below = path.empty() ? inner->get_name() : path + "/" + inner->get_name();
    paths += " " + below;
    add_case(cases, paths, *inner, below);
  }
}

}  // namespace

std::string completion(const CLI::App& app) {
  std::string keys, commands, cases, paths;
  for (const SceneKey& key : scene_keys()) keys += (keys.empty() ? "" : " ") + key.path;
  for (const CLI::App* command : app.get_subcommands({}))
    commands += (commands.empty() ? "" : " ") + command->get_name();
  add_case(cases, paths, app, "");
  std::string script = kScript;
  replace(script, "@keys@", keys);
  replace(script, "@paths@", paths);
  replace(script, "@cases@", cases);
  replace(script, "@commands@", commands);
  return script;
}

}  // namespace palpation::tool
