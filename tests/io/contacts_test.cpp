// Contacts from text that is written here, and surfaces with how sure they are, there and back.
#include "palpation/io/contacts.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "io/temporary_folder.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

ContactsFile read(const std::string& text, const ContactColumns& columns = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "points.txt") << text;
  return read_contacts(folder.path() / "points.txt", columns);
}

TEST(Contacts, TakesContactColumnsBeforePositionsAndTheirUnitFromTheirNames) {
  const ContactsFile file = read(
      "x_mm,y_mm,z_mm,contact_x_mm,contact_y_mm,contact_z_mm,normal_x,normal_y,normal_z\n"
      "0,0,9,0,0,1,0,0,2\n0,0,8,0,0,1,0,0,2\n7,0,8,7,0,1,0,0,2\nnan,0,8,nan,0,1,0,0,2\n");
  ASSERT_EQ(file.points.rows(), 2);  // one is said twice, one is no number
  EXPECT_EQ(file.points(1, 0), 0.007);
  EXPECT_EQ(file.outward(1, 2), 1.0);
  EXPECT_EQ(file.places, (std::vector<int>{2, 4}));
  EXPECT_EQ(file.remarks.size(), 2u);
}

TEST(Contacts, TakesTheMeanForceForOutAndNothingForAnAxisOfUnknownSign) {
  const ContactsFile pushed = read("x,y,z,fx_n,fy_n,fz_n\n0,0,0,0,0,1\n0.01,0,0,0,0,3\n");
  EXPECT_EQ(pushed.outward(0, 2), 1.0);
  EXPECT_EQ(read("x,y,z,nx,ny,nz\n0,0,0,0,0,-1\n0.01,0,0,0,0,-1\n").outward.rows(), 0);
}

TEST(Contacts, KnowsThatNormalsOfReadingsPointOut) {
  const ContactsFile file = read(
      "x,y,z,reading,kind,reading_unit,nx,ny,nz,contact,probing\n0,0,0,1,stop,N,0,0,-1,sliding,a\n"
      "0.01,0,0,1,way,N,0,0,-1,sliding,b\n0.02,0,0,,missed,N,0,0,-1,none,c\n");
  ASSERT_EQ(file.points.rows(), 2);
  EXPECT_EQ(file.outward(1, 2), -1.0);
  EXPECT_NE(file.outward_from.find("of these readings"), std::string::npos);
}

// Whatever takes a reading back, its place is no contact.
TEST(Contacts, LeaveOutWhatWasTakenBack) {
  const ContactsFile file = read(
      "x,y,z,reading,withdrawn,set_aside\n0,0,0,1,,\n0.01,0,0,1,yes,\n0.02,0,0,1,,slipped\n"
      "0.03,0,0,1,0,\n");
  EXPECT_EQ(file.places, (std::vector<int>{2, 5}));
}

TEST(Contacts, ReadsPlainLinesInTheUnitThatIsAskedFor) {
  const std::string text = "# a cloud\n0 0 0\n10 0 0\n";
  EXPECT_EQ(read(text, {.unit = LengthUnit::Millimetre}).points(1, 0), 0.010);
  EXPECT_THROW(read(text), IoError);
  EXPECT_THROW(read("0 0\n", {.unit = LengthUnit::Metre}), IoError);
}

TEST(Contacts, RefusesASizeThatIsNotTissue) {
  EXPECT_THROW(read("x,y,z\n0,0,0\n30,0,0\n"), IoError);  // metres, as no unit is named
  EXPECT_THROW(read("x,y,z\n"), IoError);
}

TEST(WriteMesh, BringsHeightSdBackInMetres) {
  const TemporaryFolder folder;
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.01, 0.0;
  mesh.triangles << 0, 1, 2;
  const Field sd = Vec3(1e-5, 0.0, 2e-4);
  write_mesh(folder.path() / "mesh.ply", mesh, LengthUnit::Millimetre, sd);
  EXPECT_EQ(read_mesh(folder.path() / "mesh.ply", LengthUnit::Millimetre).height_sd, sd);
  EXPECT_THROW(write_mesh(folder.path() / "mesh.obj", mesh, LengthUnit::Millimetre, sd),
               InvalidInput);
  EXPECT_THROW(write_mesh(folder.path() / "mesh.ply", mesh, LengthUnit::Millimetre, -sd),
               InvalidInput);
}

}  // namespace
}  // namespace palpation
