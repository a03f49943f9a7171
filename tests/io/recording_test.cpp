#include "palpation/io/recording.h"

#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

TEST(ReadRecording, DropsRowsWithoutReadingsAndNeedsNoHeight) {
  const TemporaryFolder folder;
  const RecordedReadings recording = read_recording(
      folder.file("r.csv", "index,x,y,reading\n0,1,2,nan\n1,3,4,5\n2,6,7,\n3,8,9,10\n4,8,8,1\n"));
  ASSERT_EQ(recording.readings.size(), 3);
  EXPECT_EQ(recording.positions.row(0), Vec3(3, 4, 0).transpose());
  EXPECT_EQ(recording.readings[1], 10.0);
}

TEST(ReadRecording, RefusesWhatHoldsNoReadingOrAnInfiniteOne) {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) {
    return io_error_of([&] { read_recording(folder.file("r.csv", text)); });
  };
  EXPECT_TRUE(contains(error_of("x,y,reading\n0,0,nan\n"), "no row holds a reading"));
  EXPECT_TRUE(
      contains(error_of("x,y,reading\n0,0,1\n0,0,inf\n"), "r.csv:3: column reading: \"inf\""));
  EXPECT_TRUE(contains(error_of("index,x,y\n0,0,0\n"), "no column \"reading\""));
  EXPECT_TRUE(contains(error_of("x,y,reading\n0,0,1\n"),
                       "r.csv: only 1 row holds a reading; a recording has at least three"));
  EXPECT_TRUE(
      contains(error_of("x,y,reading\n0,0,1\n0,0,2\n"), "r.csv: only 2 rows hold a reading"));
  EXPECT_TRUE(contains(error_of("x,y,reading\n0,0,1e31\n"),
                       "r.csv:2: column reading: \"1e31\" must be at most 1e30"));
  EXPECT_TRUE(contains(error_of("x,y,reading\n1e300,0,1\n"),
                       "r.csv:2: column x: \"1e300\" must be within 1000 m"));
  EXPECT_TRUE(contains(error_of("x,y,z,reading\n0,0,,1\n"),
                       "r.csv:2: column z: \"\" must be a finite number"));
}

TEST(ReadRecording, ReadsEveryRowOfARealOne) {
  const std::filesystem::path path =
      PALPATION_SOURCE_DIR "/../shared/data/dvrk-palp/fig_circle_forward.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const RecordedReadings recording = read_recording(path);
  ASSERT_EQ(recording.readings.size(), recording.positions.rows());
  EXPECT_EQ(recording.positions.row(0), Vec3(0.0126, -0.0345, 0.0).transpose());
  EXPECT_EQ(recording.readings[0], 0.3529);
}

}  // namespace
}  // namespace palpation
