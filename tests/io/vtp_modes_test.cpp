// VTP files as VTK itself writes them, in every mode that it has: ours must be what VTK meant.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>

#include "io/temporary_folder.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

constexpr int kSide = 40;

/// A bumpy sheet of quads and, in its last row, strips; with arrays of several kinds.
vtkSmartPointer<vtkPolyData> sheet(int precision) {
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (int i = 0; i < kSide * kSide; ++i)
    points->InsertNextPoint(i % kSide / 3.0, i / kSide / 7.0, std::sin(0.1 * i));
  vtkNew<vtkCellArray> polys, strips;
  for (int row = 0; row + 1 < kSide; ++row) {
    for (int column = 0; column + 1 < kSide; ++column) {
      const vtkIdType a = row * kSide + column;
      if (row + 2 < kSide) {
        polys->InsertNextCell({a, a + 1, a + kSide + 1, a + kSide});
      } else {
        strips->InsertNextCell({a, a + 1, a + kSide, a + kSide + 1});
      }
    }
  }
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  poly->SetPoints(points);
  poly->SetPolys(polys);
  poly->SetStrips(strips);
  vtkNew<vtkFloatArray> stiffness;
  stiffness->SetName("stiffness [N/m]");
  stiffness->SetNumberOfComponents(2);
  stiffness->SetNumberOfTuples(kSide * kSide);
  stiffness->Fill(NAN);
  poly->GetPointData()->AddArray(stiffness);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  for (vtkIdType cell = 0; cell < poly->GetNumberOfCells(); ++cell)
    names->InsertNextValue(cell % 2 == 0 ? "even" : "");
  poly->GetCellData()->AddArray(names);
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(1.5);
  poly->GetFieldData()->AddArray(time);
  return poly;
}

enum class Mode { Ascii, Binary, AppendedRaw, AppendedBase64 };

void write(vtkPolyData* poly, const std::filesystem::path& path, Mode mode, int compressor,
           bool big_endian, bool wide) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(poly);
  writer->SetFileName(path.c_str());
  writer->SetCompressorType(compressor);
  writer->SetBlockSize(1 << 12);
  writer->SetByteOrder(big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
  writer->SetHeaderType(wide ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  writer->SetIdType(wide ? vtkXMLWriter::Int64 : vtkXMLWriter::Int32);
  if (mode == Mode::Ascii) writer->SetDataModeToAscii();
  if (mode == Mode::Binary) writer->SetDataModeToBinary();
  if (mode == Mode::AppendedRaw) writer->EncodeAppendedDataOff();
  ASSERT_EQ(writer->Write(), 1);
}

void expect_sheet(const MeshFile& file, vtkPolyData* poly, const std::string& way) {
  EXPECT_TRUE(file.warnings.empty()) << way << file.warnings.front().text;
  ASSERT_EQ(file.mesh.vertices.rows(), kSide * kSide) << way;
  ASSERT_EQ(file.mesh.triangles.rows(), 2 * (kSide - 1) * (kSide - 1)) << way;
  for (int i = 0; i < kSide * kSide; ++i)
    ASSERT_EQ(Vec3(file.mesh.vertices.row(i)), Vec3(poly->GetPoint(i))) << way;
}

TEST(ReadVtp, ReadsWhatVtkWritesInEveryMode) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "a.vtp";
  for (const int precision : {VTK_FLOAT, VTK_DOUBLE}) {
    const vtkSmartPointer<vtkPolyData> poly = sheet(precision);
    for (const Mode mode : {Mode::Ascii, Mode::Binary, Mode::AppendedRaw, Mode::AppendedBase64}) {
      for (const int compressor :
           {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
        for (const bool big_endian : {false, true}) {
          write(poly, path, mode, compressor, big_endian, /*wide=*/!big_endian);
          const std::string way = "mode " + std::to_string(static_cast<int>(mode)) +
                                  ", compressor " + std::to_string(compressor) +
                                  (big_endian ? ", big-endian" : ", little-endian");
          try {
            expect_sheet(read_mesh_of_any_size(path, LengthUnit::Metre), poly, way);
          } catch (const IoError& error) {
            ADD_FAILURE() << way << ": " << error.what();
          }
        }
      }
    }
  }
}

TEST(ReadVtp, ReadsAFileWithoutCells) {
  const TemporaryFolder folder;
  vtkNew<vtkPolyData> empty;
  write(empty, folder.path() / "a.vtp", Mode::AppendedRaw, vtkXMLWriter::ZLIB, false, true);
  EXPECT_TRUE(contains(
      io_error_of([&] { read_mesh_of_any_size(folder.path() / "a.vtp", LengthUnit::Metre); }),
      "holds no vertices"));
}

TEST(ReadVtp, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const TemporaryFolder folder;
  write(sheet(VTK_FLOAT), folder.path() / "a.vtp", Mode::AppendedRaw, vtkXMLWriter::LZ4, false,
        true);
  std::fstream file(folder.path() / "a.vtp", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-3000, std::ios::end);
  file << "damaged blocks make VTK's compressors complain";
  file.close();
  EXPECT_TRUE(contains(
      io_error_of([&] { read_mesh_of_any_size(folder.path() / "a.vtp", LengthUnit::Metre); }),
      "a.vtp, byte"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace palpation
