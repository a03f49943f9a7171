/// Polygons on CGAL's exact kernel: what a Region is made of. Private to this folder.
///
/// Corners are taken from doubles as they are; corners that an overlay adds are exact rational
/// points, evaluated as soon as they are made, so that no chain of lazy expressions grows (CGAL's
/// own area() of such a polygon overflows the stack at 60,000 corners).
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <span>
#include <vector>

#include "palpation/boundary/region.h"

namespace palpation {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_2;
using ExactRing = std::vector<ExactPoint>;

/// The outer ring runs counter-clockwise, holes clockwise; each starts at its lowest corner (x
/// before y), none has a straight corner or visits a point twice, but two rings may share corners.
struct ExactPolygon {
  ExactRing outer;
  std::vector<ExactRing> holes;
};

using RingPointers = std::vector<const ExactRing*>;

/// All their rings: of each polygon the outer one, then the holes.
RingPointers ring_pointers(std::span<const ExactPolygon> polygons);

/// The nearest doubles.
Vec2 rounded(const ExactPoint& point);
PolygonWithHoles rounded(const ExactPolygon& polygon);

/// Sum of the rings' signed areas, rounded once: what is summed are integer multiples of 2^-300 of
/// the greatest coordinate, and finer ones for what is next to nothing.
double signed_area(const std::vector<ExactRing>& rings);

double area_of(std::span<const ExactPolygon> polygons);

}  // namespace palpation
