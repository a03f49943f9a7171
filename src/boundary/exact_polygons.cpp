#include "boundary/exact_polygons.h"

#include <CGAL/Fraction_traits.h>

#include <cmath>

namespace palpation {

namespace {

using Rational = ExactKernel::Exact_kernel::FT;
using Fraction = CGAL::Fraction_traits<Rational>;
using Integer = Fraction::Numerator_type;

/// GMP cuts digits off; what it cut decides about the last place.
template <typename Number>
double nearest(const Number& value) {
  const double leading = CGAL::to_double(value);
  return leading + CGAL::to_double(Number(value - Number(leading)));
}

bool is_double(const ExactPoint& point) {
  return point.approx().x().is_point() && point.approx().y().is_point();
}

/// value * 2^bits, cut to an integer.
Integer fixed_point(const Rational& value, int bits) {
  Integer numerator;
  Fraction::Denominator_type denominator;
  Fraction::Decompose()(value, numerator, denominator);
  if (bits >= 0) {
    numerator <<= static_cast<unsigned>(bits);
  } else {
    denominator <<= static_cast<unsigned>(-bits);
  }
  return numerator / denominator;
}

double greatest_coordinate(const std::vector<ExactRing>& rings) {
  double greatest = 0.0;
  for (const ExactRing& ring : rings) {
    for (const ExactPoint& point : ring) {
      greatest = std::max(
          {greatest, CGAL::abs(point.approx().x()).sup(), CGAL::abs(point.approx().y()).sup()});
    }
  }
  return greatest;
}

/// Twice the signed area, in units of 4^-bits.
Integer doubled_area(const ExactRing& ring, int bits) {
  Integer sum = 0;
  Integer last_x = fixed_point(ring.back().exact().x(), bits);
  Integer last_y = fixed_point(ring.back().exact().y(), bits);
  for (const ExactPoint& point : ring) {
    Integer x = fixed_point(point.exact().x(), bits);
    Integer y = fixed_point(point.exact().y(), bits);
    sum += last_x * y;
    sum -= x * last_y;
    std::swap(last_x, x);
    std::swap(last_y, y);
  }
  return sum;
}

Ring rounded_ring(const ExactRing& ring) {
  Ring points;
  for (const ExactPoint& point : ring) points.push_back(rounded(point));
  return points;
}

}  // namespace

RingPointers ring_pointers(std::span<const ExactPolygon> polygons) {
  RingPointers rings;
  for (const ExactPolygon& polygon : polygons) {
    rings.push_back(&polygon.outer);
    for (const ExactRing& hole : polygon.holes) rings.push_back(&hole);
  }
  return rings;
}

Vec2 rounded(const ExactPoint& point) {
  if (is_double(point)) return {point.approx().x().inf(), point.approx().y().inf()};
  return {nearest(point.exact().x()), nearest(point.exact().y())};
}

PolygonWithHoles rounded(const ExactPolygon& polygon) {
  PolygonWithHoles made{rounded_ring(polygon.outer), {}};
  for (const ExactRing& hole : polygon.holes) made.holes.push_back(rounded_ring(hole));
  return made;
}

double signed_area(const std::vector<ExactRing>& rings) {
  const double greatest = greatest_coordinate(rings);
  if (greatest == 0.0) return 0.0;
  double area = 0.0;
  // Only slivers thinner than 1e-60 of the greatest coordinate need more than the first round.
  for (int digits = 300; digits <= 1200; digits *= 2) {
    const int bits = digits - std::ilogb(greatest);
    Integer sum = 0;
    for (const ExactRing& ring : rings) {
      if (!ring.empty()) sum += doubled_area(ring, bits);
    }
    int shift = 0;
    for (; !std::isfinite(CGAL::to_double(sum)); shift += 256) sum >>= 256;
    area = std::ldexp(nearest(sum), shift - 2 * bits - 1);
    if (std::abs(area) > std::ldexp(greatest * greatest, 100 - digits)) break;
  }
  return area;
}

double area_of(std::span<const ExactPolygon> polygons) {
  std::vector<ExactRing> rings;
  for (const ExactRing* ring : ring_pointers(polygons)) rings.push_back(*ring);
  return signed_area(rings);
}

}  // namespace palpation
