// No file makes its reader take more than 64 MB and twenty times its size: neither a sound one nor
// one that was laid out to.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "io/memory_file.h"
#include "io/mesh_seeds.h"
#include "io/temporary_folder.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

using catalogue::bytes_of;
using catalogue::Shape;

#if defined(__has_feature)
#define PALPATION_HAS_FEATURE(feature) __has_feature(feature)
#else
#define PALPATION_HAS_FEATURE(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    PALPATION_HAS_FEATURE(address_sanitizer) || PALPATION_HAS_FEATURE(thread_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

// Each file is about this large, so that twenty times it is more than what is free.
constexpr int kBytes = 8'000'000;

std::int64_t kilobytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key)) return std::stoll(line.substr(key.size()));
  }
  return -1;
}

/// What reading adds to the memory of a process, at its peak: seen in a child, whose peak can be
/// set back.
std::int64_t peak_kilobytes(const std::filesystem::path& path) {
  int ends[2];
  if (::pipe(ends) != 0) return -1;
  const pid_t child = ::fork();
  if (child == 0) {
    std::ofstream("/proc/self/clear_refs") << "5";
    const std::int64_t before = kilobytes("VmRSS:");
    try {
      read_mesh_of_any_size(path, LengthUnit::Metre);
    } catch (const IoError&) {
    }
    const std::int64_t growth = kilobytes("VmHWM:") - before;
    ::_exit(::write(ends[1], &growth, sizeof growth) == sizeof growth ? 0 : 1);
  }
  std::int64_t growth = -1;
  ::close(ends[1]);
  if (::read(ends[0], &growth, sizeof growth) != sizeof growth) growth = -1;
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return growth;
}

void expect_modest(const std::string& name, const std::string& bytes) {
  if (kIsSanitized) GTEST_SKIP() << "the sanitizer's own memory would count";
  const TemporaryFolder folder;
  const MemoryFile file(folder, name);
  const std::int64_t peak = peak_kilobytes(file.with(bytes));
  EXPECT_GT(peak, 0) << name;
  EXPECT_LE(peak, (64 << 10) + 20 * static_cast<std::int64_t>(bytes.size()) / 1024)
      << name << " of " << bytes.size() << " bytes";
}

Shape sheet(int side) {
  Shape shape;
  for (int i = 0; i < side * side; ++i)
    shape.points.push_back({i % side / 64.0, i / side / 64.0, (i * 7919 % 64) / 64.0});
  for (int i = 0; i < side * side; ++i) {
    if (i % side == side - 1 || i / side == side - 1) continue;
    shape.faces.push_back({i, i + 1, i + side + 1});
    shape.faces.push_back({i, i + side + 1, i + side});
  }
  return shape;
}

TEST(MeshMemory, IsModestForSoundMeshes) {
  expect_modest("a.obj", catalogue::obj_of(sheet(360)));
  expect_modest("a.off", catalogue::off_of(sheet(360)));
  expect_modest("a.stl", catalogue::ascii_stl_of(sheet(160)));
  expect_modest("a.stl", catalogue::binary_stl_of(sheet(280)));
  expect_modest("a.ply", catalogue::ply_of(sheet(360), catalogue::PlyEncoding::Ascii));
  expect_modest("a.ply", catalogue::ply_of(sheet(400), catalogue::PlyEncoding::Little));
  expect_modest("a.vtp", catalogue::vtp_of(sheet(360)));
  expect_modest("a.vtp",
                catalogue::vtp_of(sheet(300), {.arrays = catalogue::VtpStyle::Arrays::Base64}));
}

std::string ply_header(int vertices, const std::string& coordinate, std::int64_t faces,
                       const std::string& index) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty " + coordinate + " x\nproperty " + coordinate + " y\nproperty " + coordinate +
         " z\nelement face " + std::to_string(faces) + "\nproperty list uchar " + index +
         " vertex_indices\nend_header\n";
}

TEST(MeshMemory, IsModestForFacesOfFewBytes) {
  expect_modest("empty.ply",
                ply_header(1, "uchar", kBytes, "uchar") + std::string(3 + kBytes, '\0'));
  std::string triangles =
      ply_header(256, "uchar", kBytes / 4, "uchar") + std::string(3 * 256, '\7');
  for (int i = 0; i < kBytes / 4; ++i)
    triangles += {'\3', static_cast<char>(i % 84), static_cast<char>(84 + i / 84 % 84),
                  static_cast<char>(168 + i / 7056 % 84)};
  expect_modest("bytes.ply", triangles);
}

// A polygon of 255 corners is 253 triangles.
TEST(MeshMemory, IsModestForPolygonsOfManyCorners) {
  const int polygons = kBytes / 511;
  std::string binary = ply_header(65536, "ushort", polygons, "ushort");
  for (int i = 0; i < 65536; ++i)
    binary += bytes_of(static_cast<std::uint16_t>(i)) +
              bytes_of(static_cast<std::uint16_t>(i % 251 * i % 509)) + std::string(2, '\0');
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
  for (int polygon = 0; polygon < polygons; ++polygon) {
    binary += '\xFF';
    for (int i = 0; i < 255; ++i)
      binary += bytes_of(static_cast<std::uint16_t>(257 * i + (polygon * i) % 257));
    text += "f";
    for (int i = 0; i < 255; ++i) text += " " + std::to_string(1 + 3 * i + (polygon + i) % 3);
    text += "\n";
  }
  expect_modest("polygons.ply", binary);
  expect_modest("polygons.obj", text);
}

TEST(MeshMemory, IsModestForLinesOfManyWords) {
  std::string ones;
  for (int i = 0; i < kBytes / 2; ++i) ones += " 1";
  expect_modest("face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + ones + "\n");
  expect_modest("vertex.obj", "v" + ones + "\n");
  expect_modest("vertex.off", "OFF\n1 1 0\n" + ones + "\n3 0 0 0\n");
}

TEST(MeshMemory, IsModestForVtpFilesOfManyElements) {
  const std::string head = "<VTKFile type=\"PolyData\"><PolyData>", tail = "</PolyData></VTKFile>";
  const auto repeated = [](const std::string& text) {
    std::string all;
    while (all.size() < kBytes) all += text;
    return all;
  };
  expect_modest("elements.vtp", head + repeated("<a/>") + tail);
  expect_modest("pieces.vtp", head + repeated("<Piece/>") + tail);
  expect_modest("arrays.vtp",
                head + "<Piece><PointData>" +
                    repeated("<DataArray type=\"Int8\" Name=\"a\" format=\"ascii\"/>") +
                    "</PointData></Piece>" + tail);
}

// Many pieces whose points are all the same bytes.
TEST(MeshMemory, IsModestForVtpPiecesThatShareTheirBytes) {
  std::string pieces;
  for (int i = 0; i < 1000; ++i) {
    pieces +=
        "<Piece NumberOfPoints=\"600000\"><Points><DataArray type=\"Float32\" "
        "NumberOfComponents=\"3\" format=\"appended\" "
        "offset=\"0\"/></Points></Piece>";
  }
  const std::string block(12 * 600'000, '\0');
  expect_modest("shared.vtp", "<VTKFile type=\"PolyData\"><PolyData>" + pieces +
                                  "</PolyData><AppendedData encoding=\"raw\">_" +
                                  bytes_of(static_cast<std::uint32_t>(block.size())) + block +
                                  "</AppendedData></VTKFile>");
}

}  // namespace
}  // namespace palpation
