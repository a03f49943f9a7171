/// What is mended of a mesh only on request (MeshRepair), between what a file says and the mesh
/// that is made of it. Each says in a warning how many elements it took, and where the first lies.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/polygon_soup.h"
#include "palpation/io/coordinates.h"

namespace palpation {

/// How many elements a repair took, and the place of the first.
class Repaired {
 public:
  /// Of a face, or of a triangle of it, with these corners.
  void take(const PolygonSoup& soup, int face, std::span<const int> corners);
  /// Warns, if there were any: "3 MANY, the first: face 7 in line 12 ...".
  void tell(PolygonSoup& soup, const std::string& one, const std::string& many,
            const std::string& advice) const;
  std::int64_t count() const { return count_; }

 private:
  std::int64_t count_ = 0;
  std::string first_;
};

/// Drops every triangle that has the corners of an earlier one.
void drop_duplicates(PolygonSoup& soup, std::vector<SoupTriangle>& triangles);

/// Drops the triangles without an area. One whose middle corner lies on its longest side, with one
/// neighbour there, leaves no crack: the neighbour is cut at that corner.
void drop_flat(PolygonSoup& soup, std::vector<SoupTriangle>& triangles, LengthUnit unit);

/// Keeps, of the parts that hang together by edges, the one of the largest area; of equal ones the
/// first. Needs a triangle.
void keep_largest(PolygonSoup& soup, std::vector<SoupTriangle>& triangles);

}  // namespace palpation
