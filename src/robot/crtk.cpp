#include "palpation/robot/crtk.h"

#include <array>
#include <utility>

namespace palpation {
namespace {

using enum ArmState;
using enum ArmCommand;

constexpr std::array<ArmTransition, 14> kTransitions = {{
    {Disabled, Enable, Enabled},
    {Disabled, Disable, Disabled},
    {Disabled, Unhome, Disabled},
    {Enabled, Enable, Enabled},
    {Enabled, Disable, Disabled},
    {Enabled, Pause, Paused},
    {Enabled, Home, Enabled},
    {Enabled, Unhome, Enabled},
    {Paused, Disable, Disabled},
    {Paused, Pause, Paused},
    {Paused, Resume, Enabled},
    {Paused, Unhome, Paused},
    {Fault, Disable, Disabled},
    {Fault, Unhome, Fault},
}};

constexpr std::array<std::pair<ArmState, std::string_view>, 4> kWords = {
    {{Disabled, "DISABLED"}, {Enabled, "ENABLED"}, {Paused, "PAUSED"}, {Fault, "FAULT"}}};

}  // namespace

std::span<const ArmTransition> arm_transitions() { return kTransitions; }

std::optional<ArmState> after(ArmState state, ArmCommand command) {
  for (const ArmTransition& one : kTransitions) {
    if (one.from == state && one.command == command) return one.to;
  }
  return std::nullopt;
}

std::optional<ArmState> arm_state(std::string_view word) {
  for (const auto& [state, spelled] : kWords) {
    if (spelled == word) return state;
  }
  return std::nullopt;
}

std::string_view word_of(ArmState state) {
  for (const auto& [one, spelled] : kWords) {
    if (one == state) return spelled;
  }
  return "UNDEFINED";
}

}  // namespace palpation
