/// The operating states of an arm as CRTK has them, as a table.
///
/// Source: the Collaborative Robotics Toolkit's state machine as dVRK 2.4 keeps it: a paused arm is
/// resumed, not enabled; an arm at fault can only be disabled.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace palpation {

enum class ArmState { Disabled, Enabled, Paused, Fault };
enum class ArmCommand { Enable, Disable, Pause, Resume, Home, Unhome };

/// One that is allowed.
struct ArmTransition {
  ArmState from;
  ArmCommand command;
  ArmState to;
};

/// All of them; what is not in it does not happen by command. Any state may become Fault by itself.
std::span<const ArmTransition> arm_transitions();
/// Nothing where the command is invalid in that state.
std::optional<ArmState> after(ArmState state, ArmCommand command);

/// As CRTK spells them: "ENABLED". Nothing for a word that is none.
std::optional<ArmState> arm_state(std::string_view word);
std::string_view word_of(ArmState state);

}  // namespace palpation
