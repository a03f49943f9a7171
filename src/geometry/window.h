/// A window of light on an edge, and how light reaches a place: what a search for shortest paths
/// keeps.
#pragma once

#include "palpation/base/types.h"

namespace palpation {

/// Of a distance: ways that differ by less are equally long, and both are kept.
inline constexpr double kEqualWays = 1e-12;

/// Of an edge's length: windows this narrow are none.
inline constexpr double kNarrowWindow = 1e-13;

/// The part [from, to] of a half-edge through which light falls into its face, straight from
/// `image` (not above the edge), which is sigma away from the source.
struct Window {
  int half_edge;
  int parent;  // the window that it is a part of, one face before; -1: the face before holds the
               // origin
  int origin;  // a vertex that light bends at, or -1 - the source's number
  double from, to;
  Vec2 image;
  double sigma;
  int part = -1;  // another window that was made one with this and keeps its own parent; it may
                  // have such a part in turn
};

/// How a vertex is reached.
struct Reached {
  bool is_known;
  double distance;
  int window;  // through this one; -1: straight from the origin along an edge or through `face`
  int origin;  // as a window's
  int face;
  double arrival;  // of a vertex: the angle in the face from its next corner to where the light
                   // comes from
};

}  // namespace palpation
