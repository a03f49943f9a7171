#include "palpation/robot/crtk.h"

#include <gtest/gtest.h>

#include <array>

namespace palpation {
namespace {

TEST(Crtk, ItsTableIsThatOfTheStateMachine) {
  using enum ArmState;
  constexpr std::optional<ArmState> kNone;
  using Row = std::array<std::optional<ArmState>, 6>;
  // enable, disable, pause, resume, home, unhome
  const std::array<Row, 4> expected = {Row{Enabled, Disabled, kNone, kNone, kNone, Disabled},
                                       Row{Enabled, Disabled, Paused, kNone, Enabled, Enabled},
                                       Row{kNone, Disabled, Paused, Enabled, kNone, Paused},
                                       Row{kNone, Disabled, kNone, kNone, kNone, Fault}};
  std::size_t allowed = 0;
  for (int state = 0; state < 4; ++state) {
    for (int command = 0; command < 6; ++command) {
      const auto got = after(static_cast<ArmState>(state), static_cast<ArmCommand>(command));
      EXPECT_EQ(got, expected[static_cast<std::size_t>(state)][static_cast<std::size_t>(command)])
          << state << " " << command;
      allowed += got ? 1 : 0;
    }
  }
  EXPECT_EQ(arm_transitions().size(), allowed);  // none twice
}

TEST(Crtk, StatesAreSpelledAsCrtkSpellsThem) {
  for (int state = 0; state < 4; ++state)
    EXPECT_EQ(arm_state(word_of(static_cast<ArmState>(state))), static_cast<ArmState>(state));
  EXPECT_EQ(word_of(ArmState::Fault), "FAULT");
  EXPECT_EQ(arm_state("enabled"), std::nullopt);
  EXPECT_EQ(arm_state(""), std::nullopt);
}

}  // namespace
}  // namespace palpation
