/// Small sound meshes in every format and in every way a format can be written, to be damaged by
/// tests and by who looks for crashes.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace palpation::catalogue {

struct Shape {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> faces;
};

Shape square();       ///< corners (0,0,0), (1,0,0), (1,1,0), (0,1,0); faces 0 1 2 and 0 2 3
Shape tetrahedron();  ///< closed; the normals look outward
Shape grid();  ///< 3 x 3 vertices off the plane, at coordinates with many digits, eight faces

std::string obj_of(const Shape& shape);
std::string off_of(const Shape& shape);
std::string ascii_stl_of(const Shape& shape);
/// The title may be up to 80 characters long.
std::string binary_stl_of(const Shape& shape, const std::string& title = "");

enum class PlyEncoding { Ascii, Little, Big };
std::string ply_of(const Shape& shape, PlyEncoding encoding);

/// The ways VTK writes arrays. Compressed is zlib, in blocks of 64 bytes.
struct VtpStyle {
  enum class Arrays { Ascii, Base64, AppendedRaw, AppendedBase64 } arrays = Arrays::Ascii;
  bool compressed = false;
  bool big_endian = false;
  bool wide_header = true;  ///< sizes of 8 bytes, else 4
  bool narrow = false;      ///< Float32 and Int32, else Float64 and Int64
};
std::string vtp_of(const Shape& shape, const VtpStyle& style = {});

struct MeshSeed {
  std::string name;
  std::string file;  ///< with the extension of its format
  std::string bytes;
  int vertices, faces;
};

/// Three for each format and encoding.
std::vector<MeshSeed> mesh_seeds();

/// The bytes of a number as this machine has them, reversed if asked for.
template <typename Number>
std::string bytes_of(Number number, bool reverse = false) {
  const char* first = reinterpret_cast<const char*>(&number);
  std::string bytes(first, first + sizeof number);
  return reverse ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

}  // namespace palpation::catalogue
