// Files that were cut short or damaged: an error, or a mesh with a warning, or plainly another
// valid file. Never a crash, never a hang, and never in silence a part of what there was. (Fuzzing
// goes further; this is the net below it.)
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "io/memory_file.h"
#include "io/mesh_seeds.h"
#include "io/temporary_folder.h"
#include "palpation/base/random.h"
#include "palpation/io/read_mesh.h"

namespace palpation {
namespace {

using catalogue::MeshSeed;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices.rows() == b.vertices.rows() && a.triangles.rows() == b.triangles.rows() &&
         a.vertices == b.vertices && a.triangles == b.triangles;
}

/// The faces that a file plainly has, counted by its lines; or -1 where nothing but the header's
/// count tells.
std::int64_t plain_faces(const std::string& file, const std::string& bytes) {
  if (file.ends_with(".obj"))
    return static_cast<std::int64_t>(count_of("\n" + bytes, "\nf ") +
                                     count_of("\n" + bytes, "\nf\t"));
  if (file.ends_with(".stl") && bytes.find('\0') == std::string::npos)
    return static_cast<std::int64_t>(count_of(bytes, "endfacet"));
  return -1;
}

TEST(MeshDamage, M03NeverTakesACutFileForAWholeOne) {
  const TemporaryFolder folder;
  std::vector<MeshSeed> seeds = catalogue::mesh_seeds();
  for (MeshSeed& seed : seeds) {
    // OBJ has no counts but those that a comment may tell: without, a cut between two faces cannot
    // be seen.
    if (seed.file.ends_with(".obj"))
      seed.bytes = "# " + std::to_string(seed.vertices) + " vertices, " +
                   std::to_string(seed.faces) + " faces\n" + seed.bytes;
    const MemoryFile memory(folder, seed.file);
    const TriangleMesh whole =
        read_mesh_of_any_size(memory.with(seed.bytes), LengthUnit::Metre).mesh;
    ASSERT_EQ(whole.triangles.rows(), seed.faces) << seed.name;
    for (std::size_t length = 0; length < seed.bytes.size(); ++length) {
      const std::filesystem::path path = memory.with(seed.bytes.substr(0, length));
      try {
        const MeshFile file = read_mesh_of_any_size(path, LengthUnit::Metre);
        EXPECT_TRUE(same_mesh(file.mesh, whole) || !file.warnings.empty())
            << seed.name << " cut after " << length;
      } catch (const IoError& error) {
        EXPECT_TRUE(contains(error.what(), path.string())) << error.what();
      }
    }
  }
}

TEST(MeshDamage, M03SeesACutInALineOfObj) {
  const TemporaryFolder folder;
  const MemoryFile memory(folder, "a.obj");
  const std::string whole = catalogue::obj_of(catalogue::grid());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    if (length > 0 && whole[length - 1] == '\n') continue;
    try {
      EXPECT_FALSE(read_mesh_of_any_size(memory.with(whole.substr(0, length)), LengthUnit::Metre)
                       .warnings.empty())
          << length;
    } catch (const IoError&) {
    }
  }
}

/// Up to four bytes replaced, or a stretch left out, repeated or moved.
std::string damaged(const std::string& whole, Random& random) {
  std::string bytes = whole;
  const auto place = [&] {
    return static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())));
  };
  switch (random.below(5)) {
    case 0:
      for (int i = random.below(4); i >= 0; --i)
        bytes[place()] = static_cast<char>(random.below(256));
      return bytes;
    case 1:
      for (int i = random.below(4); i >= 0; --i) bytes[place()] = bytes[place()];
      return bytes;
    case 2:
      return bytes.erase(place(), static_cast<std::size_t>(1 + random.below(8)));
    case 3:
      return bytes.insert(place(),
                          bytes.substr(place(), static_cast<std::size_t>(1 + random.below(8))));
    default:
      bytes[place()] = static_cast<char>(bytes[place()] ^ 1 << random.below(7));
      return bytes;
  }
}

// How many for each seed; PALPATION_MUTANTS asks for another number by hand.
int mutant_count() {
  const char* text = std::getenv("PALPATION_MUTANTS");
  return text != nullptr ? std::atoi(text) : 400;
}

TEST(MeshDamage, NeverLosesFacesOfADamagedFileInSilence) {
  const TemporaryFolder folder;
  Random random(1);
  for (const MeshSeed& seed : catalogue::mesh_seeds()) {
    const MemoryFile memory(folder, seed.file);
    for (int trial = 0; trial < mutant_count(); ++trial) {
      const std::string bytes = damaged(seed.bytes, random);
      const std::filesystem::path path = memory.with(bytes);
      const auto start = std::chrono::steady_clock::now();
      try {
        const MeshFile file = read_mesh_of_any_size(path, LengthUnit::Metre);
        ASSERT_GT(file.mesh.triangles.rows(), 0);
        ASSERT_LT(file.mesh.triangles.maxCoeff(), file.mesh.vertices.rows());
        ASSERT_GE(file.mesh.triangles.minCoeff(), 0);
        ASSERT_TRUE(file.mesh.vertices.allFinite());
        const bool same_counts =
            file.mesh.triangles.rows() == seed.faces &&
            (file.mesh.vertices.rows() == seed.vertices || seed.file.ends_with(".stl"));
        const bool is_plain = file.mesh.triangles.rows() == plain_faces(seed.file, bytes);
        EXPECT_TRUE(same_counts || is_plain || !file.warnings.empty())
            << seed.name << ", trial " << trial << ", now with " << file.mesh.vertices.rows()
            << " vertices and " << file.mesh.triangles.rows() << " faces:\n"
            << bytes;
      } catch (const IoError& error) {
        ASSERT_TRUE(contains(error.what(), path.string())) << error.what();
      }
      ASSERT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2))
          << seed.name << ", trial " << trial;
    }
  }
}

}  // namespace
}  // namespace palpation
