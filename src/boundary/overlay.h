/// Rings in the plane, cut at all their crossings: the one place where the exact arrangement of
/// CGAL is built. Private to this folder.
///
/// Rings belong to one of two layers. Each face of the arrangement has a winding number per layer,
/// and a part of the plane is what a predicate of these two numbers says. So a Boolean operation,
/// the area of each part and a check of the rings all come from the same overlay, and there is no
/// degenerate input: rings may cross, overlap and touch themselves and each other.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "boundary/exact_polygons.h"

namespace palpation {

/// How often the rings of either layer run counter-clockwise around a place.
using Winding = std::array<int, 2>;

class Overlay {
 public:
  using Part = std::function<bool(const Winding&)>;

  /// Zero-length edges are skipped. Throws what CGAL throws, and NumericalError if the windings of
  /// the faces and their areas do not add up to those of the rings.
  Overlay(std::span<const ExactRing* const> first, std::span<const ExactRing* const> second);

  /// The closure of the part's interior, in the normal form of ExactPolygon: equal parts give equal
  /// polygons. Part must be false for {0, 0}.
  std::vector<ExactPolygon> polygons(const Part& part) const;

  double area(const Part& part) const;

  /// Whether some face has such windings.
  bool any(const Part& part) const;

  /// The ends of the lowest edge along which rings run more than once, the lower end first.
  std::optional<std::array<ExactPoint, 2>> overlap() const;

  /// The lowest point where a ring of the first layer crosses another or itself: more than two
  /// windings meet there, as at a mere touch they do not. Only meaningful without an overlap.
  std::optional<ExactPoint> crossing() const;

  /// The lowest corner of the part.
  std::optional<ExactPoint> lowest(const Part& part) const;

 private:
  /// Runs with its face on the left. `step`: winding of that face less that of the face on the
  /// right.
  struct HalfEdge {
    int twin;
    int next;
    int face;
    int origin;
    int rings;
    Winding step;
  };
  struct Trace {
    std::vector<int> corners;
    int face;
  };
  struct DoubledAreas;

  std::vector<bool> faces_of(const Part& part) const;
  std::vector<Trace> trace(const std::vector<bool>& inside) const;
  std::vector<int> components(const std::vector<bool>& inside) const;
  void find_windings(int unbounded_face);
  void check_areas(const DoubledAreas& given) const;

  std::vector<ExactPoint> points_;
  std::vector<HalfEdge> half_edges_;
  std::vector<Winding> windings_;   ///< per face
  std::vector<int> first_of_face_;  ///< half-edges sorted by face: where each face's begin
  std::vector<int> half_edges_by_face_;
};

}  // namespace palpation
