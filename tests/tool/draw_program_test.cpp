#include "scene/draw_program.h"

#include <gtest/gtest.h>

#include "scene/stopwatch.h"

namespace palpation::tool {
namespace {

constexpr double kPatience_s = 60.0;

std::string said_of(const std::string& script, double patience_s = kPatience_s) {
  return run_helper("/bin/sh", {"-c", script}, patience_s).value_or("done");
}

TEST(RunHelper, TellsHowTheProgramEnded) {
  EXPECT_EQ(said_of("exit 0"), "done");
  EXPECT_EQ(said_of("exit 3"), "sh failed");
  EXPECT_EQ(said_of("echo no light >&2; echo at all >&2; exit 4"), "no light\nat all");
  EXPECT_EQ(said_of("echo unheard; exit 4"), "sh failed");
  EXPECT_EQ(said_of("kill -SEGV $$"), "the graphics stack failed (signal 11)");
  EXPECT_EQ(run_helper("/nowhere/palpate-draw", {}, kPatience_s), "palpate-draw cannot be started");
}

TEST(RunHelper, EndsAProgramThatTakesTooLong) {
  const Stopwatch waiting;
  EXPECT_EQ(said_of("exec sleep 1000", 0.1), "sh did not end within 0.1 s, and was ended");
  EXPECT_EQ(said_of("exec 2>&-; exec sleep 1000", 0.1),
            "sh did not end within 0.1 s, and was ended");
  EXPECT_EQ(said_of("exec yes >&2", 0.1), "sh did not end within 0.1 s, and was ended");
  EXPECT_LT(waiting.seconds(), kPatience_s);
}

TEST(RunHelper, DoesNotWaitForWhatTheProgramLeftRunning) {
  const Stopwatch waiting;
  EXPECT_EQ(said_of("sleep 100 & exit 0"), "done");
  EXPECT_LT(waiting.seconds(), kPatience_s);
}

}  // namespace
}  // namespace palpation::tool
