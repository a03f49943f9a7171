#include "palpation/io/measurements.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

/// A square of 2 x 2 cm in the plane z = 0, two triangles.
Surface square() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 0.02, 0, 0, 0.02, 0.02, 0, 0, 0.02, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return Surface(mesh);
}

std::vector<Palpation> measured(const std::string& text) {
  const TemporaryFolder folder;
  return read_measurements(folder.file("m.csv", text), square()).palpations;
}

TEST(ReadMeasurements, SaysHowManyPositionsLayOffTheSurface) {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& rows) {
    return read_measurements(folder.file("m.csv", "x,y,z,reading\n" + rows), square()).warnings;
  };
  EXPECT_TRUE(warnings("0.01,0.01,0,7\n0.01,0.012,0.00005,7\n").empty());
  const std::vector<std::string> said = warnings("0.01,0.01,0,7\n0.01,0.012,0.003,7\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("1 of 2 positions lay off the surface, by up to 0.003 m"), std::string::npos) << said[0];
}

std::string error_of(const std::string& text) {
  return io_error_of([&] { measured(text); });
}

TEST(ReadMeasurements, NeedsOnlyPositionsAndReadings) {
  const std::vector<Palpation> palpations = measured("reading,x,y,z,operator\n7.5,0.01,0.005,0.002,anna\n");
  ASSERT_EQ(palpations.size(), 1u);
  EXPECT_EQ(palpations[0].reading, 7.5);
  EXPECT_TRUE(std::isnan(palpations[0].noise_variance));
  EXPECT_EQ(palpations[0].kind, TouchKind::Stop);
  EXPECT_TRUE(palpations[0].travel.isZero(0.0));
  // Straight down to the plane, up to rounding of numbers of the order of 0.01.
  EXPECT_NEAR((square().position(palpations[0].where) - Vec3(0.01, 0.005, 0.0)).norm(), 0.0, 1e-16);
}

TEST(ReadMeasurements, TakesATableWithoutRows) { EXPECT_TRUE(measured("x,y,z,reading\n").empty()); }

TEST(ReadMeasurements, TellsAnUnknownNoiseFromNoNoise) {
  const std::vector<Palpation> palpations = measured("x,y,z,reading,noise_variance\n0,0,0,1,\n0,0,0,1,0\n0,0,0,1,0.25\n");
  EXPECT_TRUE(std::isnan(palpations[0].noise_variance));
  EXPECT_EQ(palpations[1].noise_variance, 0.0);
  EXPECT_EQ(palpations[2].noise_variance, 0.25);
}

TEST(ReadMeasurements, NamesLineAndDistanceOfAPointOffTheSurface) {
  const std::string message = error_of("x,y,z,reading\n0,0,0.005,1\n0.01,0.01,0.25,1\n");
  EXPECT_TRUE(contains(message, "m.csv:3: ")) << message;
  EXPECT_TRUE(contains(message, "0.25 m from the surface")) << message;
}

TEST(ReadMeasurements, RefusesReadingsAndCellsThatAreNone) {
  const std::string header = "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz\n0,0,0,1,,0,stop,,,\n";
  EXPECT_TRUE(contains(error_of(header + "0,0,0,nan,,0,stop,,,\n"), "m.csv:3: column reading: \"nan\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,inf,,0,stop,,,\n"), "m.csv:3: column reading: \"inf\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,,,0,stop,,,\n"), "m.csv:3: column reading: \"\""));
  EXPECT_TRUE(contains(error_of(header + "0,nan,0,1,,0,stop,,,\n"), "m.csv:3: column y: \"nan\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,1,-1,0,stop,,,\n"), "m.csv:3: column noise_variance: \"-1\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,1,nan,0,stop,,,\n"), "m.csv:3: column noise_variance: \"nan\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,1,,1.5,stop,,,\n"), "m.csv:3: column batch: \"1.5\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,1,,0,halt,,,\n"), "m.csv:3: column kind: \"halt\""));
  EXPECT_TRUE(contains(error_of(header + "0,0,0,1,,0,stop,1,,0\n"), "m.csv:3: column ty: \"\""));
  EXPECT_TRUE(contains(error_of("x,y,reading\n0,0,1\n"), "no column \"z\""));
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
  palpations[1].reading = -1e300;
  const std::string text = measurements_csv(surface, palpations);
  EXPECT_TRUE(contains(text, "0.02,0.02,0,0.3333333333333333,0.1,3,way,0.6,0.8,0,\"jammed, \"\"again\"\"\"\n")) << text;
  EXPECT_TRUE(contains(text, "0,0,0,-1e+300,,0,stop,,,,\n")) << text;
  EXPECT_EQ(measurements_csv(surface, measured(text)), text);
}

}  // namespace
}  // namespace palpation
