// Marks that real recordings must meet; without them the tests skip.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "experiments/experiment.h"

namespace palpation::tool {
namespace {

const std::filesystem::path kRecordings = PALPATION_SOURCE_DIR "/../shared/data/dvrk-palp";

// A ridge under contact that fades: the profile's plateau runs away, and its boundary is empty.
TEST(Recordings, HaveABoundaryWhereContactFades) {
  if (!std::filesystem::exists(kRecordings)) GTEST_SKIP() << kRecordings << " is absent";
  ExperimentArguments arguments;
  arguments.name = "recordings";
  arguments.material.recordings = kRecordings;
  const Study study = recordings_study(arguments);
  const auto cell = std::ranges::find_if(
      study.cells, [](const Cell& one) { return one.name == "fading contact"; });
  ASSERT_NE(cell, study.cells.end());
  int found = 0;
  for (const Figures& row : study.run(cell - study.cells.begin(), 1)) {
    if (row.word("what").find("boundaries found") == std::string::npos) continue;
    EXPECT_TRUE(row.flag("good")) << row.word("what");
    ++found;
  }
  EXPECT_EQ(found, 4);
}

}  // namespace
}  // namespace palpation::tool
