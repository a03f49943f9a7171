/// The notches of a border, filled with flat triangles.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/metric_builder.h"

namespace palpation {

/// One vertex of a border, with the edge from it to the next, tissue on the left.
struct Rim {
  int vertex;
  int half_edge;
  double length;
  double interior;     // angle of the tissue, rad
  double chord = 0.0;  // between the neighbours, across a notch
};
using BorderLoop = std::vector<Rim>;

inline std::size_t before(const BorderLoop& loop, std::size_t i) {
  return i == 0 ? loop.size() - 1 : i - 1;
}
inline std::size_t after(const BorderLoop& loop, std::size_t i) {
  return i + 1 == loop.size() ? 0 : i + 1;
}
/// Fills the notches whose chord is at most `widest`, narrow ones first, with triangles that may be
/// cut to edges of `target` later. A border that then turns around a hole of three edges is closed:
/// the loop is empty after that.
void fill_notches(BorderLoop& loop, double widest, double target, MetricBuilder& builder);

}  // namespace palpation
