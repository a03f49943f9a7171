#include "palpation/world/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

#include "palpation/base/error.h"
#include "world/tissue.h"

namespace palpation {
namespace {

enum class Rows { UpOnly, DownOnly, ToAndFro };

/// Rows along y at whole millimetres of x from 0 to 8, a reading every millimetre from y = 0 to 12
/// mm.
RecordedReadings scan(Rows rows, const std::function<double(double x_m, double y_m)>& feel) {
  RecordedReadings recording{Points(9 * 13, 3), Eigen::VectorXd(9 * 13)};
  Eigen::Index i = 0;
  for (int row = 0; row < 9; ++row) {
    const bool goes_down = rows == Rows::DownOnly || (rows == Rows::ToAndFro && row % 2 == 1);
    for (int step = 0; step < 13; ++step, ++i) {
      const double x = 1e-3 * row, y = 1e-3 * (goes_down ? 12 - step : step);
      recording.positions.row(i) << x, y, 0.0;
      recording.readings[i] = feel(x, y);
    }
  }
  return recording;
}

RecordedReadings constant_scan(Rows rows, double reading) {
  return scan(rows, [reading](double, double) { return reading; });
}

double linear(double x_m, double y_m) { return 1.0 + 100.0 * x_m - 50.0 * y_m; }

// A linear field is its own interpolant, at places between the readings too.
TEST(RecordedWorld, AnswersWithTheLinearInterpolantOfItsReadings) {
  const Surface tissue = sheet(0.008, 0.012, 0.0007);
  const RecordedWorld world(tissue, {scan(Rows::UpOnly, linear)});
  for (int face = 0; face < tissue.face_count(); face += 7) {
    const SurfacePoint where{face, Vec3(0.5, 0.3, 0.2)};
    const Vec3 p = tissue.position(where);
    const auto palpation = world.touch(where, Vec3::Zero());
    ASSERT_TRUE(palpation.has_value());
    EXPECT_NEAR(palpation->reading, linear(p.x(), p.y()),
                1e-9);  // places are rounded to a picometre, readings change by 112 per metre
    EXPECT_EQ(palpation->where.face, face);
    EXPECT_NEAR((palpation->travel - Vec3::UnitY()).norm(), 0.0, 1e-12);  // as it was recorded
  }
}

// Recorded up to x = 8 mm, touched at x = 8.5, 11 and 9.5 mm: nothing outside the readings' hull.
TEST(RecordedWorld, FeelsNothingBesideTheRecording) {
  const Surface tissue = sheet(0.012, 0.012, 0.0005);
  const RecordedWorld world(tissue, {scan(Rows::UpOnly, linear)});
  const auto touch = [&](double x_mm) {
    return world.touch(tissue.at_vertex(tissue.nearest_vertex(Vec3(1e-3 * x_mm, 0.006, 0.0))),
                       Vec3::Zero());
  };
  EXPECT_TRUE(touch(7.5).has_value());
  for (const double x_mm : {8.5, 9.5, 11.0}) EXPECT_FALSE(touch(x_mm).has_value()) << x_mm;
}

// Two patches of readings 10 mm apart: their hull spans the gap, but its middle is farther than 2
// mm from any reading.
TEST(RecordedWorld, FeelsNothingFarFromEveryReading) {
  const Surface tissue = sheet(0.014, 0.001, 0.0005);
  RecordedReadings recording{Points(12, 3), Eigen::VectorXd::Constant(12, 3.0)};
  const double x_mm[] = {0, 1, 2, 12, 13, 14};
  for (int i = 0; i < 12; ++i)
    recording.positions.row(i) << 1e-3 * x_mm[i / 2], 1e-3 * (i % 2), 0.0;
  const RecordedWorld world(tissue, {recording});
  const auto feels = [&](double x) {
    return world
        .touch(tissue.at_vertex(tissue.nearest_vertex(Vec3(1e-3 * x, 0.0, 0.0))), Vec3::Zero())
        .has_value();
  };
  for (const double x : {0.0, 1.5, 3.5, 10.5, 14.0}) EXPECT_TRUE(feels(x)) << x;
  for (const double x : {4.5, 7.0, 9.5}) EXPECT_FALSE(feels(x)) << x;
}

// 1 felt going up, 2 going down: the recording made in the direction of the move answers, the first
// where the direction is unknown or across.
TEST(RecordedWorld, AnswersFromTheRecordingThatTravelsAsTheProbeDoes) {
  const Surface tissue = sheet(0.008, 0.012, 0.001);
  const RecordedWorld world(tissue,
                            {constant_scan(Rows::UpOnly, 1.0), constant_scan(Rows::DownOnly, 2.0)});
  const SurfacePoint where = tissue.at_vertex(40);
  const auto reading = [&](const Vec3& travel) { return world.touch(where, travel)->reading; };
  EXPECT_EQ(reading(Vec3(0.0, 1.0, 0.0)), 1.0);
  EXPECT_EQ(reading(Vec3(0.0, -1.0, 0.0)), 2.0);
  EXPECT_EQ(reading(Vec3(0.9, -0.1, 0.0)), 2.0);
  EXPECT_EQ(reading(Vec3(1.0, 0.0, 0.0)), 1.0);
  EXPECT_EQ(reading(Vec3::Zero()), 1.0);
  EXPECT_EQ(world.touch(where, Vec3(0.0, -4.0, 0.0))->travel, Vec3(0.0, -1.0, 0.0));
}

// Rows to and fro have no direction of travel to speak of, so the recording that runs one way is
// preferred along its way and avoided against it.
TEST(RecordedWorld, TakesNoDirectionFromRowsToAndFro) {
  const Surface tissue = sheet(0.008, 0.012, 0.001);
  const RecordedWorld world(
      tissue, {constant_scan(Rows::ToAndFro, 1.0), constant_scan(Rows::DownOnly, 2.0)});
  const SurfacePoint where = tissue.at_vertex(40);
  EXPECT_EQ(world.touch(where, Vec3(0.0, -1.0, 0.0))->reading, 2.0);
  EXPECT_EQ(world.touch(where, Vec3(0.0, 1.0, 0.0))->reading, 1.0);
}

// Up the rows, but every second reading repeats its place: standing still is no direction, nor is
// the jump of 12 mm back to the next row's start.
TEST(RecordedWorld, IgnoresStandstillAndJumpsBetweenRows) {
  const Surface tissue = sheet(0.008, 0.012, 0.001);
  const RecordedReadings once = constant_scan(Rows::UpOnly, 1.0);
  RecordedReadings twice{Points(2 * 117, 3), Eigen::VectorXd::Constant(2 * 117, 1.0)};
  for (int i = 0; i < 2 * 117; ++i) twice.positions.row(i) = once.positions.row(i / 2);
  const RecordedWorld world(
      tissue, {constant_scan(Rows::DownOnly, 2.0), twice, constant_scan(Rows::UpOnly, 3.0)});
  // Both that run upwards fit equally well, so the first of them answers; counting standstill or
  // jumps would make the third fit better.
  EXPECT_EQ(world.touch(tissue.at_vertex(40), Vec3(0.0, 1.0, 0.0))->reading, 1.0);
}

// Tissue of 12 x 12 mm, recorded on 8 x 12 mm: 9 of 13 columns of vertices are in contact.
TEST(RecordedWorld, MapsItsReadingsAndLowWhereThereIsNoContact) {
  const Surface tissue = sheet(0.012, 0.012, 0.001);
  const RecordedWorld world(tissue, {scan(Rows::UpOnly, linear)});
  const Field map = world.map(-7.0);
  const std::vector<bool> in_contact = world.in_contact();
  EXPECT_EQ(std::count(in_contact.begin(), in_contact.end(), true), 9 * 13);
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const Vec3 p = tissue.vertex(vertex);
    EXPECT_EQ(in_contact[vertex], p.x() < 0.0085);
    EXPECT_NEAR(map[vertex], p.x() < 0.0085 ? linear(p.x(), p.y()) : -7.0,
                1e-9);  // places are rounded to a picometre, readings change by 112 per metre
  }
}

TEST(RecordedWorld, IsInContactWhereEveryRecordingAnswers) {
  const Surface tissue = sheet(0.012, 0.012, 0.001);
  RecordedReadings shifted = constant_scan(Rows::DownOnly, 2.0);
  shifted.positions.col(0).array() += 0.004;
  const std::vector<bool> in_contact =
      RecordedWorld(tissue, {constant_scan(Rows::UpOnly, 1.0), shifted}).in_contact();
  EXPECT_EQ(std::count(in_contact.begin(), in_contact.end(), true), 5 * 13);  // x = 4 to 8 mm
}

// Readings 0, 1, ..., 116 in some order: position q * 116.
TEST(RecordedWorld, HasQuantilesLinearBetweenOrderStatistics) {
  RecordedReadings recording = constant_scan(Rows::UpOnly, 0.0);
  for (int i = 0; i < 117; ++i) recording.readings[i] = (i * 50) % 117;
  const RecordedWorld world(sheet(0.008, 0.012, 0.001),
                            {recording, constant_scan(Rows::DownOnly, 500.0)});
  EXPECT_EQ(world.quantile(0.0), 0.0);
  EXPECT_EQ(world.quantile(0.5), 58.0);
  EXPECT_EQ(world.quantile(1.0), 116.0);
  EXPECT_NEAR(world.quantile(0.02), 2.32, 1e-13);
  for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(world.quantile(bad), InvalidInput) << bad;
}

TEST(RecordedWorld, OnPlanarTissueNeedsNoSearchTree) {
  const Surface tissue = sheet(0.008, 0.012, 0.001);
  RecordedWorld(tissue, {scan(Rows::UpOnly, linear)}).map(0.0);
  EXPECT_TRUE(tissue.computed().empty());
}

TEST(RecordedWorld, RefusesRecordingsThatSpanNothing) {
  const Surface tissue = sheet(0.008, 0.012, 0.001);
  EXPECT_THROW(RecordedWorld(tissue, {}), InvalidInput);
  const RecordedReadings good = constant_scan(Rows::UpOnly, 1.0);
  EXPECT_THROW(RecordedWorld(tissue, {good, {good.positions.topRows(2), good.readings.head(2)}}),
               InvalidInput);
  EXPECT_THROW(RecordedWorld(tissue, {{good.positions.topRows(13), good.readings.head(13)}}),
               InvalidInput);  // one row: a line
  EXPECT_THROW(RecordedWorld(tissue, {{good.positions, good.readings.head(13)}}), InvalidInput);
  RecordedReadings broken = good;
  broken.readings[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RecordedWorld(tissue, {broken}), InvalidInput);
  EXPECT_THROW(RecordedWorld(tissue, {good}, 0.0), InvalidInput);
}

/// Columns index, x, y, z, nx, ny, nz, reading, row of the recordings' CSV; nothing if there is no
/// such file.
RecordedReadings read_recording(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  RecordedReadings recording{Points(count, 3), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    recording.positions.row(i) << rows[i][1], rows[i][2], rows[i][3];
    recording.readings[i] = rows[i][7];
  }
  return recording;
}

// 2,641 readings on 19 rows of 139, 1.4 mm apart, a reading every half millimetre, all forward
// along y.
TEST(RecordedWorld, ReplaysARealRecordingOfADisk) {
  const std::string folder = PALPATION_SOURCE_DIR "/../shared/data/dvrk-palp/";
  const RecordedReadings forward = read_recording(folder + "fig_circle_forward.csv");
  const RecordedReadings backward = read_recording(folder + "fig_circle_backward.csv");
  if (forward.readings.size() == 0 || backward.readings.size() == 0)
    GTEST_SKIP() << "no recordings in " << folder;
  ASSERT_EQ(forward.readings.size(), 19 * 139);
  Random random(0);
  const Surface tissue(make_plane(
      {.size_m = {0.0252, 0.069}, .columns = 19, .rows = 139, .corner_m = {-0.0126, -0.0345}},
      random));
  const RecordedWorld world(tissue, {backward, forward});
  // Vertices lie where the readings do, numbered from the lowest x and y along x; the recording
  // runs along y, the row of the highest x first.
  for (int vertex = 0; vertex < tissue.vertex_count(); vertex += 101) {
    const int column = vertex % 19, row = vertex / 19;
    const auto palpation = world.touch(tissue.at_vertex(vertex), Vec3::UnitY());
    ASSERT_TRUE(palpation.has_value());
    EXPECT_NEAR(palpation->reading, forward.readings[(18 - column) * 139 + row],
                1e-9);  // rounding to a picometre
  }
  EXPECT_NE(world.touch(tissue.at_vertex(1300), Vec3::UnitY())->reading,
            world.touch(tissue.at_vertex(1300), -Vec3::UnitY())->reading);
  const std::vector<bool> in_contact = world.in_contact();
  EXPECT_GT(std::count(in_contact.begin(), in_contact.end(), true), tissue.vertex_count() * 9 / 10);
}

// A sheet bent around 50 mm and a recording that runs 1 mm above it: readings grow with the angle,
// thus linearly along the sheet. A reading 10 mm beside the tissue counts for nothing.
TEST(RecordedWorld, ReplaysOnCurvedTissue) {
  const Surface bent = bent_sheet(0.020, 0.010, 0.001, 0.050);
  const auto angle_of = [](double x_m) { return (x_m - 0.010) / 0.050; };
  RecordedReadings recording{Points(21 * 11 + 1, 3), Eigen::VectorXd(21 * 11 + 1)};
  for (int i = 0; i < 21 * 11; ++i) {
    const double angle = angle_of(1e-3 * (i % 21)), radius_m = 0.051;
    recording.positions.row(i) << 0.010 + radius_m * std::sin(angle), 1e-3 * (i / 21),
        radius_m * std::cos(angle) - 0.050;
    recording.readings[i] = angle;
  }
  recording.positions.row(21 * 11) << 0.010, 0.020, 0.0;
  recording.readings[21 * 11] = 1000.0;
  const RecordedWorld world(bent, {recording});
  for (int vertex = 0; vertex < bent.vertex_count(); ++vertex) {
    const auto palpation = world.touch(bent.at_vertex(vertex), Vec3::Zero());
    if (!palpation) continue;
    EXPECT_NEAR(palpation->reading, angle_of(1e-3 * (vertex % 21)),
                2e-3);  // a tenth of a step between readings
  }
}

}  // namespace
}  // namespace palpation
