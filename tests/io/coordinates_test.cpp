// What VTP files say of their coordinates, written and read.
#include "palpation/io/coordinates.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/square.h"
#include "io/temporary_folder.h"
#include "io/vtp_shape.h"
#include "palpation/base/error.h"
#include "palpation/io/read_boundary.h"
#include "palpation/io/read_mesh.h"
#include "palpation/io/write_vtp.h"

namespace palpation {
namespace {

namespace fs = std::filesystem;

std::string text_array(const std::string& name, const std::string& codes) {
  return "<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"1\" format=\"ascii\">" +
         codes + "</Array>\n";
}

/// A triangle of 30 mm with that field data.
std::string triangle_with(const std::string& field_data) {
  return "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n"
         "<FieldData>\n" +
         field_data +
         "</FieldData>\n<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">\n<Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
         "0 0 0 30 0 0 0 30 0</DataArray></Points>\n<Polys>"
         "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
         "</Piece>\n</PolyData>\n</VTKFile>\n";
}

const std::string kMm = "109 109 0", kM = "109 0", kRas = "82 65 83 0", kLps = "76 80 83 0";

class Coordinates : public testing::Test {
 protected:
  MeshFile read(const std::string& field_data, LengthUnit unit = LengthUnit::Millimetre) {
    std::ofstream(path_) << triangle_with(field_data);
    return read_mesh(path_, unit);
  }
  std::string refusal_of(const std::string& field_data, LengthUnit unit) {
    try {
      read(field_data, unit);
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "triangle.vtp";
};

TEST_F(Coordinates, OfAMeshAreWhatItsFieldDataSay) {
  EXPECT_EQ(read("").frame, Frame::Mesh);
  EXPECT_EQ(read(text_array("SPACE", kRas)).frame, Frame::Ras);
  const MeshFile file =
      read(text_array("UNIT", kMm) + text_array("FRAME", kLps) + text_array("SPACE", kLps));
  EXPECT_EQ(file.frame, Frame::Lps);
  EXPECT_TRUE(file.warnings.empty());
}

TEST_F(Coordinates, InAnotherUnitThanTheFileSaysAreRefused) {
  EXPECT_NE(refusal_of(text_array("UNIT", kMm), LengthUnit::Metre)
                .find("its lengths are in mm (UNIT), but it is to be read in m"),
            std::string::npos);
  EXPECT_NE(refusal_of(text_array("UNIT", kM), LengthUnit::Centimetre).find("in m (UNIT)"),
            std::string::npos);
  EXPECT_EQ(refusal_of(text_array("UNIT", kMm), LengthUnit::Millimetre), "");
}

TEST_F(Coordinates, ThatContradictThemselvesAreRefused) {
  EXPECT_NE(
      refusal_of(text_array("FRAME", kLps) + text_array("SPACE", kRas), LengthUnit::Millimetre)
          .find("contradict themselves: SPACE is RAS here, and LPS before"),
      std::string::npos);
}

TEST_F(Coordinates, InWordsThatNobodyKnowsAreAWarning) {
  const MeshFile file = read(text_array("UNIT", "105 110 99 104 0"));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0].text, "Its field data say UNIT = \"inch\", which is not understood.");
}

TEST_F(Coordinates, LeaveOtherFieldDataAlone) {
  const std::string other =
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">3.5"
      "</DataArray>\n<Array type=\"String\" Name=\"UNIT\" NumberOfTuples=\"2\" format=\"ascii\">"
      "65 0 66 0</Array>\n" +
      text_array("Patient", "65 0");
  EXPECT_TRUE(read(other).warnings.empty());
  EXPECT_EQ(read(other).frame, Frame::Mesh);
}

TEST_F(Coordinates, OfAWrittenSurfaceAreReadBack) {
  write_surface_vtp(path_, square(0.03), {}, Frame::Ras);
  EXPECT_EQ(read_mesh(path_, LengthUnit::Metre).frame, Frame::Ras);
  EXPECT_THROW(read_mesh(path_, LengthUnit::Millimetre), IoError);
}

TEST_F(Coordinates, OfABoundaryInMillimetresAreTakenForThem) {
  const Surface surface = square(0.03);
  VtpShape lines;
  lines.points = {{0.005, 0.005, 0.0}, {0.015, 0.005, 0.0}, {0.015, 0.015, 0.0}};
  lines.lines = {{0, 1, 2, 0}};
  std::ofstream(path_) << vtp_of("lines", lines, LengthUnit::Millimetre, Frame::Lps);
  EXPECT_NEAR(read_boundary_vtp(path_, surface).region.area(), 5e-5, 1e-15);
}

TEST(Frames, HaveTheNamesThatSlicerKnows) {
  EXPECT_EQ(name_of(Frame::Ras), "RAS");
  EXPECT_EQ(frame_of("LPS"), Frame::Lps);
  EXPECT_EQ(frame_of(name_of(Frame::Mesh)), Frame::Mesh);
  EXPECT_THROW(frame_of("lps"), InvalidInput);
}

TEST(VtpShapes, RefuseWhatDoesNotBelongToTheirPoints) {
  VtpShape model;
  model.points = {Vec3::Zero()};
  model.dots = {1};
  EXPECT_THROW(vtp_of("dots", model, LengthUnit::Metre, Frame::Mesh), InvalidInput);
  model.dots = {0};
  model.point_fields = {{"reading", {1.0, 2.0}}};
  EXPECT_THROW(vtp_of("dots", model, LengthUnit::Metre, Frame::Mesh), InvalidInput);
}

}  // namespace
}  // namespace palpation
