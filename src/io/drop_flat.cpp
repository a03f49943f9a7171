// Triangles without an area, and the neighbours that lie along them.
#include <algorithm>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "geometry/check_mesh.h"
#include "io/length_scale.h"
#include "io/soup_repairs.h"

namespace palpation {
namespace {

/// A flat triangle: the middle corner lies on the side from one end to the other, its longest.
struct Sliver {
  double length_m = 0.0;  ///< of that side
  int triangle = 0, start = 0, end = 0, middle = 0;
  /// The longest is next; of equal ones the first.
  bool operator<(const Sliver& other) const {
    return std::tie(length_m, other.triangle) < std::tie(other.length_m, triangle);
  }
};

class FlatDropper {
 public:
  FlatDropper(const PolygonSoup& soup, std::vector<SoupTriangle>& triangles, LengthUnit unit)
      : triangles_(triangles), gone_(triangles.size(), false) {
    for (const Vec3& point : soup.points)
      points_m_.push_back(point.unaryExpr([unit](double value) { return to_metres(value, unit); }));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (!is_flat(static_cast<int>(t))) continue;
      dropped_.take(soup, triangles[t].face, triangles[t].corners);
      slivers_.push(sliver_of(static_cast<int>(t)));
    }
  }

  void drop() {
    if (slivers_.empty()) return;
    for (std::size_t t = 0; t < triangles_.size(); ++t) enter(static_cast<int>(t));
    // Each cut takes a long side away; many in a row along one line could still take too long.
    std::int64_t cuts_left = 4 * dropped_.count();
    while (!slivers_.empty()) {
      const Sliver sliver = slivers_.top();
      slivers_.pop();
      if (gone_[sliver.triangle]) continue;
      leave(sliver.triangle);
      const int neighbour = neighbour_at(sliver.start, sliver.end);
      if (neighbour < 0) continue;
      if (cuts_left-- > 0 && cut(neighbour, sliver)) continue;
      ++open_;
    }
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!gone_[t]) triangles_[count++] = triangles_[t];
    }
    triangles_.resize(count);
  }

  void tell(PolygonSoup& soup) const {
    dropped_.tell(
        soup, "triangle without an area was dropped", "triangles without an area were dropped",
        (open_ == 0 ? std::string("Neighbours along them were cut: no crack is left.")
                    : std::to_string(open_) + (open_ == 1 ? " of them leaves" : " of them leave") +
                          " a seam, as two corners were in one place, or more than two "
                          "triangles met: welding may close it."));
  }

 private:
  static std::uint64_t key(int a, int b) {
    return std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32 |
           static_cast<std::uint32_t>(std::max(a, b));
  }

  const Vec3& corner(int t, std::size_t i) const { return points_m_[triangles_[t].corners[i]]; }
  bool is_flat(int t) const { return !has_area(corner(t, 0), corner(t, 1), corner(t, 2)); }

  Sliver sliver_of(int t) const {
    Sliver sliver{.length_m = -1.0, .triangle = t};
    for (std::size_t i = 0; i < 3; ++i) {
      const double length_m = (corner(t, (i + 1) % 3) - corner(t, i)).stableNorm();
      if (!(length_m > sliver.length_m)) continue;
      const auto& corners = triangles_[t].corners;
      sliver = {length_m, t, corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]};
    }
    return sliver;
  }

  void enter(int t) {
    for (std::size_t i = 0; i < 3; ++i)
      at_edge_[key(triangles_[t].corners[i], triangles_[t].corners[(i + 1) % 3])].push_back(t);
  }

  void leave(int t) {
    for (std::size_t i = 0; i < 3; ++i)
      std::erase(at_edge_[key(triangles_[t].corners[i], triangles_[t].corners[(i + 1) % 3])], t);
    gone_[t] = true;
  }

  /// One of those that are left at an edge; -1 without.
  int neighbour_at(int a, int b) const {
    const auto found = at_edge_.find(key(a, b));
    return found == at_edge_.end() || found->second.empty() ? -1 : found->second.front();
  }

  /// In two, from the sliver's middle corner to the neighbour's far one. False where that would
  /// leave the surface no surface, or the middle corner lies in the place of another.
  bool cut(int neighbour, const Sliver& sliver) {
    const Vec3 &start = points_m_[sliver.start], &end = points_m_[sliver.end],
               &middle = points_m_[sliver.middle];
    if (middle == start || middle == end || at_edge_[key(sliver.start, sliver.end)].size() > 1)
      return false;
    const SoupTriangle whole = triangles_[neighbour];
    const int far = *std::find_if(whole.corners.begin(), whole.corners.end(), [&](int corner) {
      return corner != sliver.start && corner != sliver.end;
    });
    if (far == sliver.middle || neighbour_at(sliver.middle, far) >= 0) return false;
    leave(neighbour);
    for (const int replaced : {sliver.start, sliver.end}) {
      SoupTriangle part = whole;
      std::replace(part.corners.begin(), part.corners.end(), replaced, sliver.middle);
      const auto t = static_cast<int>(triangles_.size());
      triangles_.push_back(part);
      gone_.push_back(false);
      enter(t);
      if (is_flat(t)) slivers_.push(sliver_of(t));
    }
    return true;
  }

  std::vector<SoupTriangle>& triangles_;
  std::vector<Vec3> points_m_;
  std::vector<bool> gone_;
  std::priority_queue<Sliver> slivers_;
  std::unordered_map<std::uint64_t, std::vector<int>> at_edge_;
  Repaired dropped_;
  std::int64_t open_ = 0;
};

}  // namespace

void drop_flat(PolygonSoup& soup, std::vector<SoupTriangle>& triangles, LengthUnit unit) {
  FlatDropper dropper(soup, triangles, unit);
  dropper.drop();
  dropper.tell(soup);
}

}  // namespace palpation
