#include "palpation/io/measurements.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/square.h"
#include "io/temporary_folder.h"

namespace palpation {
namespace {

std::vector<Palpation> measured(const std::string& text) {
  const TemporaryFolder folder;
  return read_measurements(folder.file("m.csv", text), square()).palpations;
}

TEST(ReadMeasurements, NeedsOnlyPositionsAndReadings) {
  const std::vector<Palpation> palpations =
      measured("reading,x,y,z,operator\n7.5,0.01,0.005,0.002,anna\n");
  ASSERT_EQ(palpations.size(), 1u);
  EXPECT_EQ(palpations[0].reading, 7.5);
  EXPECT_TRUE(std::isnan(palpations[0].noise_variance));
  EXPECT_EQ(palpations[0].kind, TouchKind::Stop);
  EXPECT_TRUE(palpations[0].travel.isZero(0.0));
  // Straight down to the plane, up to rounding of numbers of the order of 0.01.
  EXPECT_NEAR((square().position(palpations[0].where) - Vec3(0.01, 0.005, 0.0)).norm(), 0.0, 1e-16);
}

TEST(ReadMeasurements, TellsAnUnknownNoiseFromNoNoise) {
  const std::vector<Palpation> palpations =
      measured("x,y,z,reading,noise_variance\n0,0,0,1,\n0,0,0,1,0\n0,0,0,1,0.25\n");
  EXPECT_TRUE(std::isnan(palpations[0].noise_variance));
  EXPECT_EQ(palpations[1].noise_variance, 0.0);
  EXPECT_EQ(palpations[2].noise_variance, 0.25);
}

TEST(ReadMeasurements, TakesEmptyVariancesForNoneWhereTheFieldHasNoNoise) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.file("m.csv", "x,y,z,reading\n0,0,0,1\n0,0,0,2\n");
  EXPECT_EQ(read_measurements(path, square()).places, 1);
  const std::string error =
      io_error_of([&] { read_measurements(path, square(), {.empty_noise_is_none = true}); });
  EXPECT_TRUE(contains(error, "m.csv:3: the reading 2 contradicts 1 in line 2")) << error;
}

TEST(ReadMeasurements, SetsAsideRowsThatWereGivenTwice) {
  const TemporaryFolder folder;
  const std::string rows = "0,0,0,1.5\n0.01,0,0,2.25\n0,0.01,0,1.75\n";
  const MeasurementsFile file =
      read_measurements(folder.file("m.csv", "x,y,z,reading\n" + rows + rows), square());
  ASSERT_EQ(file.palpations.size(), 6u);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(file.palpations[row].set_aside, "");
    EXPECT_EQ(file.palpations[row + 3].set_aside, "copy of line " + std::to_string(row + 2));
  }
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(contains(file.warnings[0], "3 rows repeat earlier ones")) << file.warnings[0];
  EXPECT_TRUE(contains(file.warnings[0], "line 5 repeats line 2")) << file.warnings[0];
}

// What two sessions say alike they say twice.
TEST(ReadMeasurements, KeepsWhatAnotherSessionRepeats) {
  for (const Palpation& palpation :
       measured("x,y,z,reading,session\n0,0,0,7,a\n0.01,0,0,8,a\n0,0,0,7,b\n0.01,0,0,8,b\n"))
    EXPECT_EQ(palpation.set_aside, "");
}

TEST(ReadMeasurements, NamesLinesAlsoWhereSomeAreLeftOut) {
  const TemporaryFolder folder;
  const MeasurementsFile file = read_measurements(
      folder.file("m.csv", "x,y,z,reading\n0.01,0.01,0.3,3\n0,0,0,1.5\n0,0,0,1.5\n0.01,0,0,2\n"),
      square(), {.leave_out_off_tissue = true});
  ASSERT_EQ(file.palpations.size(), 3u);
  EXPECT_EQ(file.palpations[1].set_aside, "copy of line 3");
}

// As when two exports are one file: readings of a later session were made later.
TEST(ReadMeasurements, LetsASessionsBatchesFollowThoseBeforeIt) {
  std::vector<int> batches;
  for (const Palpation& palpation :
       measured("x,y,z,reading,session,batch\n0,0,0,7,a,0\n0.01,0,0,8,a,1\n0,0.01,0,7,b,0\n"
                "0.01,0.01,0,8,b,1\n"))
    batches.push_back(palpation.batch);
  EXPECT_EQ(batches, (std::vector{0, 1, 2, 3}));
}

TEST(ReadMeasurements, KeepsWhatASensorThatCountsRepeatsNowAndThen) {
  for (const Palpation& palpation :
       measured("x,y,z,reading\n0,0,0,7\n0,0,0,8\n0,0,0,7\n0,0,0,6\n0,0,0,9\n"))
    EXPECT_EQ(palpation.set_aside, "");
}

TEST(MeasurementsCsv, ComesBackAsItWasWritten) {
  const Surface surface = square();
  std::vector<Palpation> palpations(2);
  palpations[0] = {.where = surface.at_vertex(2),
                   .reading = 1.0 / 3.0,
                   .noise_variance = 0.1,
                   .batch = 3,
                   .kind = TouchKind::Way,
                   .travel = Vec3(0.6, 0.8, 0.0),
                   .set_aside = "jammed, \"again\""};
  palpations[1].where = surface.at_vertex(0);
  palpations[1].reading = -1e30;
  const std::string text = measurements_csv(surface, palpations);
  EXPECT_TRUE(contains(
      text, "0.02,0.02,0,0.3333333333333333,0.1,3,way,0.6,0.8,0,\"jammed, \"\"again\"\"\"\n"))
      << text;
  EXPECT_TRUE(contains(text, "0,0,0,-1e+30,,0,stop,,,,\n")) << text;
  EXPECT_EQ(measurements_csv(surface, measured(text)), text);
}

TEST(MeasurementsCsv, KeepsColumnsThatMeanNothingHere) {
  const Surface surface = square();
  const TemporaryFolder folder;
  const MeasurementsFile file = read_measurements(
      folder.file("m.csv", "who,x,y,z,reading,t\n\"Anna, M.\",0.01,0.012,0,7,1.50\n,0,0,0,8,\n"),
      surface);
  const std::string text = measurements_csv(surface, file.palpations, file.foreign);
  EXPECT_TRUE(contains(text, ",set_aside,who,t\n")) << text;
  EXPECT_TRUE(contains(text, "0.01,0.012,0,7,,0,stop,,,,,\"Anna, M.\",1.50\n")) << text;
  EXPECT_TRUE(contains(text, "0,0,0,8,,0,stop,,,,,,\n")) << text;
  EXPECT_THROW(measurements_csv(surface, {}, file.foreign), InvalidInput);
}

TEST(ReadMeasurements, SetsAsideWhatAPersonTookBack) {
  const std::vector<Palpation> palpations = measured(
      "x,y,z,reading,withdrawn,set_aside,t,session\n"
      "0,0,0,1,,,0.5,morning\n0.01,0,0,2,slipped,,1.5,morning\n"
      "0,0.01,0,3,1,,2,noon\n0.01,0.01,0,4,0,,3,noon\n0.02,0,0,5,no,jammed,4,noon\n");
  ASSERT_EQ(palpations.size(), 5u);
  EXPECT_EQ(palpations[0].set_aside, "");
  EXPECT_EQ(palpations[1].set_aside, "withdrawn: slipped");
  EXPECT_EQ(palpations[2].set_aside, "withdrawn");
  EXPECT_EQ(palpations[3].set_aside, "");
  EXPECT_EQ(palpations[4].set_aside, "jammed");
}

TEST(ReadMeasurements, TellsWhereTimeDoesNotRise) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& rows) {
    return read_measurements(folder.file("m.csv", "x,y,z,reading,t,session\n" + rows), square())
        .warnings;
  };
  EXPECT_TRUE(warnings("0,0,0,1,0.5,a\n0.01,0,0,2,,a\n0,0.01,0,3,7,a\n0.01,0.01,0,4,3,b\n").empty())
      << "each session has a clock of its own";
  const std::vector<std::string> sorted_by_place =
      warnings("0,0,0,1,5,a\n0.01,0,0,2,4,a\n0,0.01,0,3,7,a\n0.01,0.01,0,4,3,a\n");
  ASSERT_EQ(sorted_by_place.size(), 1u);
  EXPECT_TRUE(contains(sorted_by_place[0], "t falls 2 times, first in line 3"))
      << sorted_by_place[0];
  const std::vector<std::string> in_words = warnings("0,0,0,1,noon,a\n0.01,0,0,2,1,a\n");
  ASSERT_EQ(in_words.size(), 1u);
  EXPECT_TRUE(contains(in_words[0], "t is no number of seconds, first \"noon\" in line 2"));
}

TEST(ReadMeasurements, LeavesOutWhatLiesOffTheTissueWhereAsked) {
  const TemporaryFolder folder;
  const MeasurementRules rules{.leave_out_off_tissue = true};
  const MeasurementsFile file = read_measurements(
      folder.file("m.csv",
                  "x,y,z,reading,who\n-0.00102,0.01,0,2,a\n0.01,0.01,0,1,b\n0.01,0.01,0.3,3,c\n"),
      square(), rules);
  ASSERT_EQ(file.palpations.size(), 1u);
  EXPECT_EQ(file.foreign.rows, (std::vector<std::vector<std::string>>{{"b"}}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(contains(file.warnings[0],
                       "2 of 3 readings lie off the tissue and were left out, the farthest by 0.3 "
                       "m in line 4"))
      << file.warnings[0];
  const std::filesystem::path all = folder.file("all.csv", "x,y,z,reading\n10,12,0,1\n8,9,0,2\n");
  EXPECT_TRUE(contains(io_error_of([&] { read_measurements(all, square(), rules); }),
                       "(is it in millimetres? positions are metres); no reading lies on the"));
}

TEST(ReadMeasurements, RefusesTwoUnits) {
  const TemporaryFolder folder;
  const std::filesystem::path two =
      folder.file("m.csv", "x,y,z,reading,reading_unit\n0,0,0,1,N/mm\n0.01,0,0,2,kPa\n");
  EXPECT_TRUE(contains(io_error_of([&] { read_measurements(two, square()); }),
                       ":3: column reading_unit: \"kPa\" is another unit than \"N/mm\""));
  const std::filesystem::path one =
      folder.file("o.csv", "x,y,z,reading,reading_unit\n0,0,0,1,N/mm\n0.01,0,0,2,\n");
  EXPECT_EQ(read_measurements(one, square(), {.reading_unit = "N/mm"}).palpations.size(), 2u);
  EXPECT_TRUE(
      contains(io_error_of([&] { read_measurements(one, square(), {.reading_unit = "kPa"}); }),
               "the scene's reading_unit"));
}

}  // namespace
}  // namespace palpation
