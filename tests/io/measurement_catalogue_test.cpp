#include "io/measurement_catalogue.h"

#include <gtest/gtest.h>

#include <set>

#include "io/square.h"
#include "io/temporary_folder.h"
#include "palpation/io/measurements.h"

namespace palpation {
namespace {

using catalogue::MeasurementCase;

void expect_read(const MeasurementCase& one, const MeasurementsFile& file) {
  const std::string name = one.row + " " + one.name;
  EXPECT_EQ(file.palpations.size(), static_cast<std::size_t>(one.rows)) << name;
  EXPECT_EQ(file.places, one.places) << name;
  ASSERT_EQ(file.warnings.size(), one.warned_with.size())
      << name << (file.warnings.empty() ? "" : ": " + file.warnings.front());
  for (std::size_t i = 0; i < file.warnings.size(); ++i)
    EXPECT_TRUE(contains(file.warnings[i], one.warned_with[i])) << name << ": " << file.warnings[i];
}

TEST(MeasurementCatalogue, EveryFileEndsAsItsRowSays) {
  const TemporaryFolder folder;
  const Surface tissue = square();
  for (const MeasurementCase& one : catalogue::measurement_cases()) {
    const std::filesystem::path path = folder.file("m.csv", one.text);
    if (one.refused_with.empty()) {
      expect_read(one, read_measurements(path, tissue));
      continue;
    }
    const std::string error = io_error_of([&] { read_measurements(path, tissue); });
    EXPECT_EQ(error.rfind(path.string(), 0), 0u) << one.row << " " << one.name << ": " << error;
    EXPECT_LT(error.size(), 400u) << "an error is a sentence: " << one.name;
    for (const std::string& words : one.refused_with)
      EXPECT_TRUE(contains(error, words))
          << one.row << " " << one.name << ": " << error << "\nlacks: " << words;
  }
}

TEST(MeasurementCatalogue, HasEveryRow) {
  std::set<std::string> rows;
  for (const MeasurementCase& one : catalogue::measurement_cases()) rows.insert(one.row);
  for (const catalogue::MeasurementRowElsewhere& row : catalogue::measurement_rows_elsewhere())
    rows.insert(row.row);
  for (int number = 1; number <= 20; ++number)
    EXPECT_TRUE(rows.contains((number < 10 ? "S0" : "S") + std::to_string(number))) << number;
}

TEST(MeasurementCatalogue, AFileCutAtAnyByteIsReadInPartOrRefused) {
  const TemporaryFolder folder;
  const Surface tissue = square();
  const std::string whole =
      "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz,set_aside\n0.01,0.012,0,7,0.1,2,stop,1,0,0,"
      "\n0.01,0.013,0,8,,,way,,,,\"a, b\"\n";
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::filesystem::path path = folder.file("m.csv", whole.substr(0, size));
    try {
      EXPECT_LE(read_measurements(path, tissue).palpations.size(), 2u);
    } catch (const IoError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path.string(), 0), 0u) << error.what();
    }
  }
}

TEST(MeasurementCatalogue, ReadsAHundredThousandRowsAndTellsPlacesApart) {
  const TemporaryFolder folder;
  std::string text = "x,y,z,reading\n";
  for (int i = 0; i < 100000; ++i)
    text +=
        "0.0" + std::to_string(10 + i % 10) + ",0.0" + std::to_string(10 + i / 10 % 10) + ",0,7\n";
  const MeasurementsFile file = read_measurements(folder.file("m.csv", text), square());
  EXPECT_EQ(file.palpations.size(), 100000u);
  EXPECT_EQ(file.places, 100);
}

}  // namespace
}  // namespace palpation
