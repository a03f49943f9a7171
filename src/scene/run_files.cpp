#include "scene/run_files.h"

#include <algorithm>

namespace palpation::tool {
namespace {

constexpr std::string_view kDigits = "0123456789";

}  // namespace

bool is_step(std::string_view name) {
  constexpr std::string_view kStart = "step_", kEnd = ".vtp";
  if (!name.starts_with(kStart) || !name.ends_with(kEnd)) return false;
  name.remove_prefix(kStart.size());
  name.remove_suffix(std::min(kEnd.size(), name.size()));
  return name.size() >= 3 && name.find_first_not_of(kDigits) == std::string_view::npos;
}

bool is_run_file(std::string_view name) {
  constexpr std::string_view kFolder = "steps/";
  if (name.starts_with(kFolder)) return is_step(name.substr(kFolder.size()));
  return std::ranges::find(kRunFiles, name) != kRunFiles.end();
}

bool is_partial(std::string_view name) { return name.find(".partial-") != std::string_view::npos; }

}  // namespace palpation::tool
