/// Where places lie for straight distances between them.
///
/// Depths in a boundary, gaps between touches and disks that may hide in them matter over some
/// millimetres. On planar tissue they are straight through space; on curved tissue straight in its
/// chart, which knows that two flanks of a fold are far apart, unless the field is one of straight
/// distances in space itself, or there is no chart.
#pragma once

#include <span>
#include <vector>

#include "palpation/belief/prior.h"
#include "palpation/readings/palpation.h"

namespace palpation {

class Layout {
 public:
  /// Straight through space.
  Layout(Surface surface)
      : surface_(std::move(surface)) {
  }  // NOLINT(google-explicit-constructor): a surface lies where it is
  /// As the field's metric sees it.
  explicit Layout(const Prior& prior);

  const Surface& surface() const { return surface_; }
  Vec3 at(int vertex) const;
  Vec3 at(const SurfacePoint& point) const;
  /// Of all vertices.
  std::vector<Vec3> vertices() const;
  /// Of the palpations that are not set aside.
  std::vector<Vec3> touched(std::span<const Palpation> palpations) const;
  /// The metric of these distances.
  Metric metric() const { return in_chart_ ? Metric::Chart : Metric::Ambient; }

 private:
  Surface surface_;
  bool in_chart_ = false;
};

}  // namespace palpation
