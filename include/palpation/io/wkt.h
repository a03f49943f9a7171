/// Regions as well-known text, the format of boundary.wkt: chart coordinates in metres.
#pragma once

#include <filesystem>
#include <string>

#include "palpation/io/boundary_file.h"

namespace palpation {

/// "MULTIPOLYGON (((x y, ...), (hole)), ...)" with the shortest digits that read back as the same
/// doubles, or "MULTIPOLYGON EMPTY".
std::string to_wkt(const Region& region);

/// One POLYGON or MULTIPOLYGON with two coordinates a point; each ring has at least four points and
/// ends where it began. A byte order mark is welcome; what Region tidies away is told. Throws
/// IoError with the byte: for other text, coordinates beyond 1e9 m, what Region has against a
/// polygon, and polygons without any area, which are more likely a slip than nothing.
BoundaryFile read_wkt(const std::filesystem::path& path);
/// The same from text; `name` stands for the path in messages.
BoundaryFile parse_wkt(const std::string& text, const std::string& name);

}  // namespace palpation
