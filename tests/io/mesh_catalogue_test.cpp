// The catalogue of bad mesh files: every row has its cases, and every case gives what its row says.
#include "io/mesh_catalogue.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <numbers>
#include <regex>

#include "geometry/self_intersection.h"
#include "io/memory_file.h"
#include "io/mesh_seeds.h"
#include "io/temporary_folder.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

using catalogue::Accepted;
using catalogue::MeshCase;
using catalogue::NoSurface;
using catalogue::Refused;

constexpr int kRows = 46;

std::string row_name(int row) { return (row < 10 ? "M0" : "M") + std::to_string(row); }

std::string name_of(const MeshCase& example) {
  return example.row + ", " + example.name + ", " + example.file;
}

/// That a message begins with the path and the place, and says all that it should.
void expect_refusal(const std::string& message, const std::filesystem::path& path,
                    const Refused& expected) {
  const std::string start = path.string() + expected.place + ": ";
  EXPECT_EQ(message.substr(0, start.size()), start) << message;
  for (const std::string& part : expected.parts)
    EXPECT_TRUE(contains(message, part)) << part << "\n" << message;
}

void expect_warnings(const MeshFile& file, const std::vector<std::string>& parts) {
  std::string all;
  for (const MeshWarning& warning : file.warnings) {
    all += warning.text + "\n";
    EXPECT_FALSE(warning.advice.empty()) << warning.text;
    EXPECT_TRUE(std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
      return contains(warning.text, part);
    })) << warning.text;
  }
  for (const std::string& part : parts) EXPECT_TRUE(contains(all, part)) << part << "\n" << all;
}

void expect_counts(const MeshFile& file, int vertices, int faces) {
  EXPECT_EQ(file.mesh.vertices.rows(), vertices);
  EXPECT_EQ(file.mesh.triangles.rows(), faces);
}

/// Reads a case and compares; an error that is not expected ends it.
struct Judge {
  const std::filesystem::path& path;

  MeshFile read() const { return read_mesh_of_any_size(path, LengthUnit::Metre); }

  void operator()(const Refused& expected) const {
    expect_refusal(io_error_of([&] { read(); }), path, expected);
  }

  void operator()(const Accepted& expected) const {
    const MeshFile file = read();
    expect_counts(file, expected.vertices, expected.faces);
    expect_warnings(file, expected.warnings);
    EXPECT_NO_THROW(Surface(file.mesh));
  }

  void operator()(const NoSurface& expected) const {
    const MeshFile file = read();
    expect_counts(file, expected.vertices, expected.faces);
    expect_warnings(file, expected.warnings);
    try {
      Surface surface(file.mesh);
      ADD_FAILURE() << "a surface";
    } catch (const InvalidMesh& error) {
      for (const std::string& part : expected.parts)
        EXPECT_TRUE(contains(error.what(), part)) << part << "\n" << error.what();
    }
  }
};

TEST(MeshCatalogue, EveryCaseGivesWhatItsRowSays) {
  const TemporaryFolder folder;
  for (const MeshCase& example : catalogue::mesh_cases()) {
    SCOPED_TRACE(name_of(example));
    const MemoryFile file(folder, example.file);
    const std::filesystem::path& path = file.with(example.bytes);
    try {
      std::visit(Judge{path}, example.expected);
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

// Whatever the row: a path, then a line or a byte or an element, and a rule.
TEST(MeshCatalogue, EveryErrorNamesFileAndPlaceAndRule) {
  const TemporaryFolder folder;
  const std::regex line_or_byte("^(:[0-9]+|, byte [0-9]+): .{10,}"),
      element("^: .*(face [0-9]+|strip|file is empty|holds no|its content).*");
  for (const MeshCase& example : catalogue::mesh_cases()) {
    if (!std::holds_alternative<Refused>(example.expected)) continue;
    const MemoryFile file(folder, example.file);
    const std::filesystem::path& path = file.with(example.bytes);
    const std::string message =
        io_error_of([&] { read_mesh_of_any_size(path, LengthUnit::Metre); });
    ASSERT_EQ(message.substr(0, path.string().size()), path.string());
    const std::string rest = message.substr(path.string().size());
    EXPECT_TRUE(std::regex_search(rest, line_or_byte) || std::regex_search(rest, element))
        << name_of(example) << rest;
    EXPECT_LT(rest.size(), 400u) << name_of(example) << " quotes too much of the file";
    EXPECT_TRUE(std::all_of(rest.begin(), rest.end(), [](char c) {
      return static_cast<unsigned char>(c) >= 0x20;
    })) << name_of(example);
  }
}

// A row is covered by cases of the table, or by a test whose name begins with it.
TEST(MeshCatalogue, EveryRowIsCovered) {
  std::string covered;
  for (const MeshCase& example : catalogue::mesh_cases()) covered += example.row + " ";
  const ::testing::UnitTest& tests = *::testing::UnitTest::GetInstance();
  for (int suite = 0; suite < tests.total_test_suite_count(); ++suite) {
    const ::testing::TestSuite& group = *tests.GetTestSuite(suite);
    for (int i = 0; i < group.total_test_count(); ++i)
      covered += std::string(group.GetTestInfo(i)->name()).substr(0, 3) + " ";
  }
  for (int row = 1; row <= kRows; ++row)
    EXPECT_TRUE(contains(covered, row_name(row))) << row_name(row);
}

TEST(MeshCatalogue, M01NamesPathAndReasonWhereThereIsNothingToRead) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.obj");
  std::filesystem::create_symlink("loop.obj", folder.path() / "loop.obj");
  std::filesystem::create_symlink("nowhere.obj", folder.path() / "dangling.obj");
  std::filesystem::create_symlink("/dev/null", folder.path() / "null.obj");
  ASSERT_EQ(::mkfifo((folder.path() / "fifo.obj").c_str(), 0600), 0);
  std::filesystem::permissions(folder.file("locked.obj", catalogue::obj_of(catalogue::square())),
                               std::filesystem::perms::none);
  const std::vector<std::pair<std::string, std::string>> reasons = {
      {"none.obj", "No such file"},      {"folder.obj", "is a folder"},
      {"loop.obj", "symbolic links"},    {"dangling.obj", "No such file"},
      {"null.obj", "no regular file"},   {"fifo.obj", "no regular file"},
      {"none.obj/a.obj", "No such file"}};
  for (const auto& [name, reason] : reasons) {
    const std::filesystem::path path = folder.path() / name;
    const std::string message = io_error_of([&] { read_mesh(path, LengthUnit::Metre); });
    EXPECT_TRUE(contains(message, path.string() + ": cannot read: ") && contains(message, reason))
        << message;
  }
  if (::geteuid() == 0) return;  // who may read everything
  EXPECT_TRUE(
      contains(io_error_of([&] { read_mesh(folder.path() / "locked.obj", LengthUnit::Metre); }),
               "Permission denied"));
}

TEST(MeshCatalogue, M01FollowsALinkToAFile) {
  const TemporaryFolder folder;
  folder.file("square.obj", catalogue::obj_of(catalogue::square()));
  std::filesystem::create_symlink("square.obj", folder.path() / "link.obj");
  EXPECT_EQ(
      read_mesh_of_any_size(folder.path() / "link.obj", LengthUnit::Metre).mesh.triangles.rows(),
      2);
}

TEST(MeshCatalogue, M13ReadsTheDecimalPointInAnyLocale) {
  const TemporaryFolder folder;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL,
                 "de_DE.UTF-8");  // where it is not installed, the table still refuses the comma
  const auto path = folder.file("a.obj", "v 0 0 0\nv 1.5 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(read_mesh_of_any_size(path, LengthUnit::Metre).mesh.vertices(1, 0), 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

Surface surface_of(const catalogue::Shape& shape) {
  const TemporaryFolder folder;
  return Surface(
      read_mesh_of_any_size(folder.file("a.off", catalogue::off_of(shape)), LengthUnit::Metre)
          .mesh);
}

TEST(MeshCatalogue, M35TakesAClosedSurfaceWhichHasNoChart) {
  const Surface closed = surface_of(catalogue::tetrahedron());
  EXPECT_TRUE(closed.topology().is_closed());
  EXPECT_EQ(closed.topology().euler, 2);
  EXPECT_FALSE(closed.has_chart());
  EXPECT_THROW(closed.chart(), InvalidInput);
}

/// A band of quads round an axis; the ends may be joined to make a torus.
catalogue::Shape band(int around, int along, bool joined) {
  catalogue::Shape shape;
  const int rings = joined ? along : along + 1;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const double u = 2.0 * std::numbers::pi * i / around,
                   v = 2.0 * std::numbers::pi * ring / (joined ? along : 4 * along);
      const double radius = joined ? 3.0 + std::cos(v) : 1.0 + ring;
      shape.points.push_back(
          {radius * std::cos(u), radius * std::sin(u), joined ? std::sin(v) : 0.0});
    }
  }
  for (int ring = 0; ring < along; ++ring) {
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around, upper = (ring + 1) % rings;
      const int a = ring * around + i, b = ring * around + next, c = upper * around + next,
                d = upper * around + i;
      shape.faces.push_back({a, c, b});
      shape.faces.push_back({a, d, c});
    }
  }
  return shape;
}

TEST(MeshCatalogue, M36TakesHolesAndHandlesAndCountsThem) {
  const Surface ring = surface_of(band(8, 2, /*joined=*/false));
  EXPECT_EQ(ring.border_loops().size(), 2u);
  EXPECT_EQ(ring.topology().euler, 0);
  EXPECT_TRUE(ring.has_chart());  // it is flat
  const Surface torus = surface_of(band(8, 6, /*joined=*/true));
  EXPECT_TRUE(torus.topology().is_closed());
  EXPECT_EQ(torus.topology().euler, 0);
  EXPECT_EQ(torus.topology().handles, 1);
  EXPECT_FALSE(torus.has_chart());
}

catalogue::Shape moved(catalogue::Shape shape, double factor, double offset) {
  for (auto& point : shape.points) {
    for (double& coordinate : point) coordinate = factor * coordinate + offset;
  }
  return shape;
}

TEST(MeshCatalogue, M38TakesASurfaceThatRunsThroughItselfAndFindsWhere) {
  catalogue::Shape shape = catalogue::square();
  // A second sheet, upright through the middle of the first.
  for (const std::array<double, 3>& point :
       {std::array{-0.4, 0.3, -1.0}, {0.8, 0.3, -1.0}, {0.5, 0.3, 1.0}})
    shape.points.push_back(point);
  shape.faces.push_back({4, 5, 6});
  const SelfIntersections found = self_intersections(surface_of(shape));
  EXPECT_EQ(found.pairs, 2);
  EXPECT_EQ(found.first, (std::array{0, 2}));
}

TEST(MeshCatalogue, M39GivesTheSameAtAnyScale) {
  const double area = surface_of(catalogue::grid()).area();
  for (const double factor : {1e-9, 1e-6, 1e6, 1e9}) {
    EXPECT_NEAR(surface_of(moved(catalogue::grid(), factor, 0.0)).area() / (factor * factor * area),
                1.0, 1e-9)
        << factor;
  }
}

TEST(MeshCatalogue, M41GivesTheSameFarFromTheOrigin) {
  // Multiples of 2^-20: at 1e6 they are doubles still.
  catalogue::Shape shape = catalogue::grid();
  for (auto& point : shape.points) {
    for (double& coordinate : point)
      coordinate = std::round(std::ldexp(1e-3 * coordinate, 20)) / std::ldexp(1.0, 20);
  }
  for (auto& point : shape.points) point[2] = 0.0;
  EXPECT_NEAR(surface_of(moved(shape, 1.0, 1e6)).area() / surface_of(shape).area(), 1.0, 1e-9);
  EXPECT_TRUE(surface_of(moved(shape, 1.0, 1e6)).is_planar());
}

TEST(MeshCatalogue, M40RefusesASizeThatNoTissueHasAndSuggestsTheUnit) {
  const TemporaryFolder folder;
  const std::filesystem::path path =
      folder.file("a.obj", "v 0 0 0\nv 120 0 0\nv 0 120 0\nf 1 2 3\n");
  EXPECT_EQ(extent_m(read_mesh(path, LengthUnit::Millimetre).mesh),
            0.12);  // 120 / 1000 is rounded once
  const std::string message = io_error_of([&] { read_mesh(path, LengthUnit::Metre); });
  EXPECT_TRUE(contains(message, path.string() + ": read in m the mesh is 120 m long")) << message;
  EXPECT_TRUE(contains(message, "is its unit mm or cm?")) << message;
  EXPECT_EQ(extent_m(read_mesh_of_any_size(path, LengthUnit::Metre).mesh), 120.0);
  const std::filesystem::path speck =
      folder.file("b.obj", "v 0 0 0\nv 1e-6 0 0\nv 0 1e-6 0\nf 1 2 3\n");
  EXPECT_TRUE(contains(io_error_of([&] { read_mesh(speck, LengthUnit::Metre); }),
                       "no known unit makes it so"));
}

TEST(MeshCatalogue, M42ReadsAMillionVertices) {
  const int side = 1000;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000\nproperty ushort x\nproperty "
      "ushort y\nproperty uchar z\nelement "
      "face " +
      std::to_string(2 * (side - 1) * (side - 1)) +
      "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto add = [&bytes](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (int i = 0; i < side * side; ++i) {
    add(static_cast<std::uint16_t>(i % side));
    add(static_cast<std::uint16_t>(i / side));
    add(std::uint8_t{0});
  }
  for (int row = 0; row + 1 < side; ++row) {
    for (int column = 0; column + 1 < side; ++column) {
      const int a = row * side + column;
      for (const auto& face :
           {std::array{a, a + 1, a + side + 1}, std::array{a, a + side + 1, a + side}}) {
        bytes += '\3';
        for (const int corner : face) add(std::int32_t{corner});
      }
    }
  }
  const TemporaryFolder folder;
  const MeshFile file = read_mesh(folder.file("a.ply", bytes), LengthUnit::Millimetre);
  EXPECT_EQ(file.mesh.vertices.rows(), 1'000'000);
  EXPECT_EQ(file.mesh.triangles.rows(), 2 * 999 * 999);
  EXPECT_TRUE(file.warnings.empty());
}

// To open the FIFO would wait for a writer for ever.
TEST(MeshCatalogue, M44OpensNoOtherFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "library").c_str(), 0600), 0);
  const std::string text =
      "mtllib library\nmtllib ../../../etc/passwd\nmaplib library\nusemtl skin\n" +
      catalogue::obj_of(catalogue::square());
  EXPECT_EQ(
      read_mesh_of_any_size(folder.file("a.obj", text), LengthUnit::Metre).mesh.triangles.rows(),
      2);
}

// What a called file would have added would be missing from the mesh without a word.
TEST(MeshCatalogue, M44RefusesAMeshThatCallsAnotherFile) {
  const TemporaryFolder folder;
  for (const char* call : {"call more.obj", "csh make_more"}) {
    const std::string text = catalogue::obj_of(catalogue::square()) + call + "\n";
    const std::string message =
        io_error_of([&] { read_mesh_of_any_size(folder.file("a.obj", text), LengthUnit::Metre); });
    const auto line = std::to_string(std::count(text.begin(), text.end(), '\n'));
    EXPECT_TRUE(contains(message, "a.obj:" + line + ": ")) << message;
    EXPECT_TRUE(contains(message, "runs another file, which is not read")) << message;
  }
}

}  // namespace
}  // namespace palpation
