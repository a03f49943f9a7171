// The faults of the physical recordings, where they are present: read, laid on a plane, screened.
#include <gtest/gtest.h>

#include <filesystem>

#include "palpation/geometry/make_plane.h"
#include "palpation/io/recording.h"
#include "palpation/readings/screening.h"

namespace palpation {
namespace {

TEST(RealFaults, FourPokesThatJammedAreFoundAmong861) {
  const std::filesystem::path path =
      PALPATION_SOURCE_DIR "/../shared/data/dvrk-palp/dense_grid.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const RecordedReadings recording = read_recording(path);
  Random unused(0);
  const Surface tissue(make_plane({.size_m = {0.024, 0.059}, .columns = 25, .rows = 60}, unused));
  std::vector<Palpation> pokes;
  for (Eigen::Index i = 0; i < recording.readings.size(); ++i) {
    Palpation palpation;
    palpation.where = tissue.project(recording.positions.row(i));
    palpation.reading = recording.readings[i];
    pokes.push_back(palpation);
  }
  const std::vector<Palpation> result = screened(tissue, pokes);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!result[i].set_aside.empty()) found.push_back(i);
  }
  EXPECT_EQ(found, (std::vector<std::size_t>{129, 130, 131, 214}));
}

}  // namespace
}  // namespace palpation
