/// What is odd about a surface that can be worked on all the same: what `palpate info` says of it,
/// and a run before it starts.
#pragma once

#include <string>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation::tool {

struct EdgeLengths {
  double shortest_m = 0.0, mean_m = 0.0, longest_m = 0.0;
};
EdgeLengths edge_lengths(const TriangleMesh& mesh);

/// A sentence where edges are longer than a probe resolves; else nothing.
std::string coarse_words(const Surface& surface);

/// More triangles than that are not searched for places where they meet: each takes ten
/// microseconds.
inline constexpr int kMostFacesToCross = 200'000;

/// What was found, and what to do; both empty where it does not run through itself, is flat, or is
/// too large to tell.
struct CrossingWords {
  std::string found, advice;
};
CrossingWords crossing_words(const Surface& surface);

/// All of these, a sentence or two each.
std::vector<std::string> surface_remarks(const Surface& surface);

}  // namespace palpation::tool
