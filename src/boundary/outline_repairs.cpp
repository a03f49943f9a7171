#include "boundary/outline_repairs.h"

#include "boundary/outline.h"

namespace palpation {

namespace {

std::string counted(int count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many) + " left out";
}

}  // namespace

std::vector<std::string> OutlineRepairs::words() const {
  std::vector<std::string> words;
  if (repeated_corners > 0)
    words.push_back(counted(repeated_corners, "repeated corner was", "repeated corners were"));
  if (spike_corners > 0)
    words.push_back(counted(spike_corners, "corner of a spike of no width was",
                            "corners of spikes of no width were"));
  if (rings_without_area > 0)
    words.push_back(
        counted(rings_without_area, "ring without area was", "rings without area were"));
  return words;
}

OutlineRepairs repairs_of(std::span<const PolygonWithHoles> polygons) {
  OutlineRepairs repairs;
  const auto add = [&](const Ring& ring, const std::string& name) {
    const Untidy untidy = untidy_parts(ring, "repairs_of", name);
    repairs.repeated_corners += untidy.repeats;
    repairs.spike_corners += untidy.spikes;
    repairs.rings_without_area += untidy.has_no_area ? 1 : 0;
  };
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::string which = which_polygon(i, polygons.size());
    add(polygons[i].outer, "the outer ring" + which);
    for (std::size_t k = 0; k < polygons[i].holes.size(); ++k)
      add(polygons[i].holes[k], "hole " + std::to_string(k) + which);
  }
  return repairs;
}

}  // namespace palpation
