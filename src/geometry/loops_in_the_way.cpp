#include "geometry/loops_in_the_way.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

namespace palpation {
namespace {

/// Where the border loops but the longest are: the holes, as one takes them.
std::string where_holes_are(const std::vector<std::vector<int>>& border_loops,
                            const Points& vertices) {
  constexpr std::size_t kMostNamed = 3;
  std::vector<std::pair<double, Vec3>> loops;  // length, middle
  for (const std::vector<int>& loop : border_loops) {
    double length = 0.0;
    Vec3 middle = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      length += (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).norm();
      middle += vertices.row(loop[i]).transpose() / static_cast<double>(loop.size());
    }
    loops.emplace_back(length, middle);
  }
  std::ranges::sort(loops, std::greater<>(), &std::pair<double, Vec3>::first);
  std::string words;
  for (std::size_t i = 1; i < std::min(loops.size(), 1 + kMostNamed); ++i) {
    const Vec3 middle_mm = loops[i].second * 1e3;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%s%.1f mm long around (%.1f, %.1f, %.1f) mm",
                  i == 1 ? ": beside the longest, " : ", ", loops[i].first * 1e3, middle_mm.x(),
                  middle_mm.y(), middle_mm.z());
    words += text.data();
  }
  return words + (loops.size() > 1 + kMostNamed ? " and more" : "");
}

}  // namespace

std::string loops_in_the_way(const Topology& topology,
                             const std::vector<std::vector<int>>& border_loops,
                             const Points& vertices) {
  const auto counted = [](int count, const std::string& one) {
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
  };
  std::string found;
  if (topology.components > 1) found += counted(topology.components, "component") + ", ";
  if (topology.handles > 0) found += counted(topology.handles, "handle") + ", ";
  found += topology.is_closed()
               ? "no border (it is closed)"
               : counted(topology.borders, "border loop") + where_holes_are(border_loops, vertices);
  return "only a disk of one component, one border loop and no handles can be laid flat, and it "
         "has " +
         found;
}

}  // namespace palpation
