/// The header of a PLY file: which elements follow, and how their numbers are written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_source.h"

namespace palpation {

enum class PlyEncoding { Ascii, Little, Big };
enum class PlyScalar { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::Float64;
  std::optional<PlyScalar> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  std::int64_t line = 0;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes
  std::int64_t lines = 0;
};

/// In bytes.
std::size_t size_of(PlyScalar type);

bool is_real(PlyScalar type);

/// Whether a whole number is one that the type holds.
bool holds(PlyScalar type, std::int64_t value);

/// Reads it without trust: throws InvalidMesh or IoError at the line that is no line of a PLY
/// header.
PlyHeader read_ply_header(const MeshSource& source);

}  // namespace palpation
