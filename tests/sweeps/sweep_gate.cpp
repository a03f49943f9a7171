// COUNT set points of drivers that know how to touch, and every now and then do not, through the
// gate. Ends with 1 where one was permitted that its laws forbid.
//
// usage: sweep_gate COUNT SEED        a million take some seconds
#include <cstdio>
#include <cstdlib>

#include "robot/gate_play.h"

int main(int count, char** words) {
  using palpation::GatePlay;
  if (count != 3) return std::fprintf(stderr, "usage: sweep_gate COUNT SEED\n"), 2;
  const int commands = std::atoi(words[1]);
  const auto seed = static_cast<std::uint64_t>(std::atoll(words[2]));
  GatePlay::Counts all;
  constexpr double kMischief[] = {0.0, 0.0002, 0.001, 0.005, 0.02, 0.1, 0.3, 0.9};
  constexpr int kAtOnce = 5000;
  for (std::uint64_t play = 0; all.commands < commands; ++play) {
    const double mischief = kMischief[play % 8];
    const GatePlay::Counts now = GatePlay(1000 * seed + play, mischief).play(kAtOnce);
    if (!now.fault.empty()) {
      std::printf("seed %llu, mischief %g: %s\n",
                  static_cast<unsigned long long>(1000 * seed + play), mischief, now.fault.c_str());
      return 1;
    }
    all.commands += now.commands;
    all.permitted += now.permitted;
    all.pressed += now.pressed;
    all.held += now.held;
    all.backwards += now.backwards;
  }
  std::printf(
      "%d set points: %d permitted, %d of them pressing, %d sent back, %d answers Hold; none "
      "that the laws forbid\n",
      all.commands, all.permitted, all.pressed, all.backwards, all.held);
  return all.permitted > 0 && all.pressed > 0 && all.held > 0 ? 0 : 1;
}
