#include "fuzz/target.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/geometry/make_plane.h"

namespace palpation::fuzz {
namespace {

[[noreturn]] void stop(const char* words) {
  std::fprintf(stderr, "%s\n", words);
  std::abort();
}

TriangleMesh plane(int side) {
  Random unused(1);
  return make_plane({.size_m = {0.025, 0.025}, .columns = side, .rows = side}, unused);
}

TriangleMesh without_middle() {
  TriangleMesh mesh = plane(4);  // nine cells: faces 8 and 9 are the middle one
  Triangles kept(mesh.triangles.rows() - 2, 3);
  kept << mesh.triangles.topRows(8), mesh.triangles.bottomRows(mesh.triangles.rows() - 10);
  mesh.triangles = kept;
  return mesh;
}

TriangleMesh bent(TriangleMesh mesh) {
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
    mesh.vertices(i, 2) = 8.0 * mesh.vertices(i, 0) * mesh.vertices(i, 0);
  return mesh;
}

TriangleMesh octahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.vertices *= 0.01;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  return mesh;
}

TriangleMesh two_pieces() {
  const TriangleMesh one = plane(3);
  TriangleMesh mesh;
  mesh.vertices.resize(2 * one.vertices.rows(), 3);
  mesh.vertices << one.vertices, one.vertices;
  mesh.vertices.bottomRows(one.vertices.rows()).col(0).array() += 0.05;
  mesh.triangles.resize(2 * one.triangles.rows(), 3);
  mesh.triangles << one.triangles,
      (one.triangles.array() + static_cast<int>(one.vertices.rows())).matrix();
  return mesh;
}

}  // namespace

MemoryFile::MemoryFile(const std::uint8_t* bytes, std::size_t size)
    : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
  if (descriptor_ < 0) stop("no file in memory");
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::write(descriptor_, bytes + done, size - done);
    if (count <= 0) stop("no room for a file in memory");
    done += static_cast<std::size_t>(count);
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void expect(bool holds, const char* claim) {
  if (!holds) stop(claim);
}

std::uint8_t Numbers::byte() {
  if (rest_.empty()) return 0;
  const std::uint8_t first = rest_.front();
  rest_ = rest_.subspan(1);
  return first;
}

double Numbers::real() {
  const int kind = byte() % 8;
  if (kind < 5) return byte() % 16;
  const double whole = byte() % 16;
  if (kind == 5) return std::nextafter(whole, std::numeric_limits<double>::infinity());
  if (kind == 6) return std::nextafter(whole, -std::numeric_limits<double>::infinity());
  double raw = 0.0;
  std::uint8_t bits[sizeof raw];
  for (std::uint8_t& bit : bits) bit = byte();
  std::memcpy(&raw, bits, sizeof raw);
  return std::isfinite(raw) ? raw : whole;
}

const Surface& sheet() {
  static const Surface the_sheet(plane(6));
  return the_sheet;
}

std::span<const Surface> surfaces() {
  static const std::vector<Surface> all{sheet(),
                                        Surface(without_middle()),
                                        Surface(bent(plane(5))),
                                        Surface(bent(without_middle())),
                                        Surface(octahedron()),
                                        Surface(two_pieces())};
  return all;
}

}  // namespace palpation::fuzz
