// What is written is read back by VTK itself, so that the files mean to others what they mean here.
#include "palpation/io/write_vtp.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "io/square.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, gone afterwards.
class WriteVtp : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("write_vtp_" + std::string(test->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

// 0.1 has no exact binary form, so rounding to float would show.
Surface high_square() { return square(0.01, 0.1); }

vtkSmartPointer<vtkPolyData> read_back(const fs::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0u);
  return reader->GetOutput();
}

std::string text_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

BoundaryCurve triangle_curve(CurveKind kind, int part, bool hole) {
  return {.points = {{0.001, 0.001, 0.1}, {0.009, 0.002, 0.1}, {0.004, 0.008, 0.1}},
          .kind = kind,
          .part = part,
          .hole = hole};
}

TEST_F(WriteVtp, KeepsEveryBitOfPositionsAndFields) {
  const Surface surface = high_square();
  const Field mean = (Field(4) << 1.0 / 3.0, -0.0, 1e-300, 7.9).finished();
  const Field stddev =
      (Field(4) << 0.1, 0.2, std::numeric_limits<double>::quiet_NaN(), 1e300).finished();
  write_surface_vtp(folder_ / "surface.vtp", surface, {{"mean", mean}, {"stddev", stddev}});

  const auto polydata = read_back(folder_ / "surface.vtp");
  ASSERT_EQ(polydata->GetNumberOfPoints(), 4);
  ASSERT_EQ(polydata->GetNumberOfPolys(), 2);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(Vec3(polydata->GetPoint(i)), surface.vertex(i));
    EXPECT_EQ(polydata->GetPointData()->GetArray("mean")->GetComponent(i, 0), mean[i]);
  }
  EXPECT_TRUE(std::isnan(polydata->GetPointData()->GetArray("stddev")->GetComponent(2, 0)));
  EXPECT_EQ(polydata->GetPointData()->GetArray("stddev")->GetComponent(3, 0), 1e300);
}

TEST_F(WriteVtp, KeepsTheTrianglesAndTheirSense) {
  write_surface_vtp(folder_ / "surface.vtp", high_square(), {});
  const auto polydata = read_back(folder_ / "surface.vtp");
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  polydata->GetPolys()->GetCellAtId(1, size, corners);
  ASSERT_EQ(size, 3);
  EXPECT_EQ(std::vector<vtkIdType>(corners, corners + 3), (std::vector<vtkIdType>{0, 2, 3}));
}

TEST_F(WriteVtp, RefusesAFieldOfAnotherSizeOrTwoOfOneName) {
  const Surface surface = high_square();
  EXPECT_THROW(write_surface_vtp(folder_ / "surface.vtp", surface, {{"mean", Field::Zero(3)}}),
               InvalidInput);
  EXPECT_THROW(write_surface_vtp(folder_ / "surface.vtp", surface,
                                 {{"mean", Field::Zero(4)}, {"mean", Field::Zero(4)}}),
               InvalidInput);
  EXPECT_THROW(write_surface_vtp(folder_ / "surface.vtp", surface, {{"", Field::Zero(4)}}),
               InvalidInput);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(WriteVtp, ClosesEveryCurveAndTellsWhatItIs) {
  const std::vector<BoundaryCurve> curves = {triangle_curve(CurveKind::Estimate, 0, false),
                                             triangle_curve(CurveKind::Estimate, 0, true),
                                             triangle_curve(CurveKind::BandOuter, 2, false)};
  write_boundary_vtp(folder_ / "boundary.vtp", high_square(), curves);

  const auto polydata = read_back(folder_ / "boundary.vtp");
  ASSERT_EQ(polydata->GetNumberOfLines(), 3);
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  polydata->GetLines()->GetCellAtId(2, size, points);
  ASSERT_EQ(size, 4);  // three corners, and the first again
  EXPECT_EQ(points[0], points[3]);
  EXPECT_EQ(Vec3(polydata->GetPoint(points[1])), curves[2].points[1]);

  vtkCellData* cells = polydata->GetCellData();
  auto* names = vtkStringArray::SafeDownCast(cells->GetAbstractArray("kind_name"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(std::string(names->GetValue(0)), "estimate");
  EXPECT_EQ(std::string(names->GetValue(2)), "band_outer");
  EXPECT_EQ(cells->GetArray("kind")->GetComponent(2, 0), 3.0);
  EXPECT_EQ(cells->GetArray("part")->GetComponent(2, 0), 2.0);
  EXPECT_EQ(cells->GetArray("hole")->GetComponent(0, 0), 0.0);
  EXPECT_EQ(cells->GetArray("hole")->GetComponent(1, 0), 1.0);
}

TEST_F(WriteVtp, WritesABoundaryWithoutCurves) {
  write_boundary_vtp(folder_ / "boundary.vtp", high_square(), {});
  const auto polydata = read_back(folder_ / "boundary.vtp");
  EXPECT_EQ(polydata->GetNumberOfLines(), 0);
  EXPECT_NE(polydata->GetCellData()->GetAbstractArray("kind_name"), nullptr);
}

TEST_F(WriteVtp, RefusesACurveThatIsNotOnTheTissue) {
  BoundaryCurve curve = triangle_curve(CurveKind::Truth, 0, false);
  curve.points[1].z() = 0.2;
  EXPECT_THROW(write_boundary_vtp(folder_ / "boundary.vtp", high_square(), std::vector{curve}),
               InvalidInput);
  curve.points[1].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_boundary_vtp(folder_ / "boundary.vtp", high_square(), std::vector{curve}),
               InvalidInput);
  curve.points.resize(1);
  EXPECT_THROW(write_boundary_vtp(folder_ / "boundary.vtp", high_square(), std::vector{curve}),
               InvalidInput);
}

TEST_F(WriteVtp, TheSameContentIsTheSameBytes) {
  const Field mean = (Field(4) << 1.0, 2.0, 3.0, 4.0).finished();
  write_surface_vtp(folder_ / "a.vtp", high_square(), {{"mean", mean}});
  write_surface_vtp(folder_ / "b.vtp", high_square(), {{"mean", mean}});
  EXPECT_EQ(text_in(folder_ / "a.vtp"), text_in(folder_ / "b.vtp"));
  EXPECT_FALSE(text_in(folder_ / "a.vtp").empty());
}

TEST_F(WriteVtp, AFolderThatDoesNotExistIsAWriteErrorWithThePathAndNothingIsPrinted) {
  const fs::path path = folder_ / "missing" / "surface.vtp";
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string message;
  try {
    write_surface_vtp(path, high_square(), {});
  } catch (const WriteError& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
}

// A file can stand where a folder is named; and what cannot be written must not harm what is there.
TEST_F(WriteVtp, TheOldFileStaysWhereTheNewOneIsRefused) {
  write_surface_vtp(folder_ / "surface.vtp", high_square(), {});
  const std::string before = text_in(folder_ / "surface.vtp");
  EXPECT_THROW(
      write_surface_vtp(folder_ / "surface.vtp", high_square(), {{"mean", Field::Zero(3)}}),
      InvalidInput);
  EXPECT_THROW(write_surface_vtp(folder_ / "surface.vtp" / "below.vtp", high_square(), {}),
               WriteError);
  EXPECT_EQ(text_in(folder_ / "surface.vtp"), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}),
            1);  // no temporary file is left
}

TEST_F(WriteVtp, ACollectionNamesItsStepsInOrderAndEscapesThem) {
  write_pvd(folder_ / "steps.pvd", {"steps/step_000.vtp", "a<b>&\"c\".vtp"});
  EXPECT_EQ(
      text_in(folder_ / "steps.pvd"),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n"
      "    <DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"steps/step_000.vtp\"/>\n"
      "    <DataSet timestep=\"1\" group=\"\" part=\"0\" file=\"a&lt;b>&amp;&quot;c&quot;.vtp\"/>\n"
      "  </Collection>\n"
      "</VTKFile>\n");
}

}  // namespace
}  // namespace palpation
