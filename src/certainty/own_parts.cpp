#include "certainty/own_parts.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "boundary/superlevel_parts.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

constexpr double kStep_m = 0.001;
/// Readings so near a part are of it: what has half the contrast reads just the level, and may lie
/// a hair outside. Two standard deviations of how far off a first boundary may be.
constexpr double kBeside_m = 0.002;

int corner_at(const Surface& surface, const SurfacePoint& place) {
  Eigen::Index corner = 0;
  place.barycentric.maxCoeff(&corner);
  return surface.triangle(place.face)[corner];
}

/// The strongest first, plateaus and contrasts by their height above low.
OwnParts ordered(OwnParts parts, const Field& field, double low) {
  for (OwnPart& part : parts) {
    part.summit =
        *std::ranges::max_element(part.vertices, {}, [&](int vertex) { return field[vertex]; });
    part.contrast = field[part.summit] - low;
  }
  std::ranges::sort(parts, std::greater{}, &OwnPart::contrast);
  for (std::size_t i = parts.size(); i-- > 0;) {
    parts[i].contrast /= parts.front().contrast;
    parts[i].plateau = static_cast<int>(i);
  }
  return parts;
}

/// Uphill from a place, by steps of a millimetre at most.
int summit_near(const Surface& surface, const Field& field, const SurfacePoint& place) {
  int summit = corner_at(surface, place);
  for (;;) {
    int next = summit;
    for (const int other : vertices_near(surface, summit, kStep_m))
      if (field[other] > field[next]) next = other;
    if (next == summit) return summit;
    summit = next;
  }
}

/// Of rising lists.
bool share_one(const std::vector<int>& some, const std::vector<int>& others) {
  return std::ranges::any_of(others,
                             [&](int one) { return std::ranges::binary_search(some, one); });
}

bool meets_any(const OwnParts& parts, const std::vector<int>& vertices) {
  return std::ranges::any_of(
      parts, [&](const OwnPart& part) { return share_one(part.vertices, vertices); });
}

}  // namespace

OwnParts parts_inside(const Surface& surface, const Field& depth, const Field& field, double low,
                      const EdgeData& data) {
  OwnParts felt;
  for (std::vector<int>& vertices : superlevel_parts(surface, depth, 0.0)) {
    const bool is_felt = std::ranges::any_of(data.places, [&](const SurfacePoint& place) {
      const Vec3 at = surface.position(place);
      return std::ranges::any_of(vertices, [&](int vertex) {
        return (surface.vertex(vertex) - at).squaredNorm() < kBeside_m * kBeside_m;
      });
    });
    if (is_felt) felt.push_back({.vertices = std::move(vertices)});
  }
  return ordered(std::move(felt), field, low);
}

std::vector<int> around_summit(const Surface& surface, const Field& field, double low,
                               const SurfacePoint& place, std::span<const int> others) {
  int summit = summit_near(surface, field, place);
  if (std::ranges::count(others, summit) > 0) summit = corner_at(surface, place);
  const double height = field[summit] - low;
  if (!(height > 0.0)) return {};
  const auto is_others = [&](int vertex) {
    const Vec3 here = surface.vertex(vertex);
    const double far = (surface.vertex(summit) - here).squaredNorm();
    return std::ranges::any_of(others, [&](int other) {
      return other == vertex || (surface.vertex(other) - here).squaredNorm() < far;
    });
  };
  for (std::vector<int>& vertices : superlevel_parts(surface, field, low + 0.5 * height)) {
    if (!std::ranges::binary_search(vertices, summit)) continue;
    std::erase_if(vertices, is_others);
    return std::ranges::binary_search(vertices, summit) ? std::move(vertices) : std::vector<int>();
  }
  return {};
}

OwnParts with_part_at(OwnParts parts, const Surface& surface, const Field& field, double low,
                      const SurfacePoint& place) {
  std::vector<int> others;
  for (const OwnPart& part : parts)
    others.insert(others.end(), part.vertices.begin(), part.vertices.end());
  std::vector<int> vertices = around_summit(surface, field, low, place, others);
  if (vertices.empty()) return parts;
  parts.push_back({.vertices = std::move(vertices)});
  return ordered(std::move(parts), field, low);
}

bool reaches_border(const Surface& surface, const OwnPart& part) {
  return std::ranges::any_of(surface.border_loops(), [&](const std::vector<int>& loop) {
    return share_one(part.vertices, loop);
  });
}

std::vector<int> nearest_parts(const Layout& layout, const OwnParts& parts) {
  const std::vector<Vec3> at = layout.vertices();
  std::vector<int> nearest(at.size(), 0);
  if (parts.size() < 2) return nearest;
  for (std::size_t vertex = 0; vertex < at.size(); ++vertex) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t part = 0; part < parts.size(); ++part) {
      for (const int inside : parts[part].vertices) {
        const double squared = (at[inside] - at[vertex]).squaredNorm();
        if (!(squared < least)) continue;
        least = squared;
        nearest[vertex] = static_cast<int>(part);
      }
    }
  }
  return nearest;
}

std::vector<int> plateaus_of(const Surface& surface, const OwnParts& parts,
                             const std::vector<int>& nearest,
                             std::span<const SurfacePoint> places) {
  std::vector<int> plateaus(places.size(), 0);
  if (parts.empty()) return plateaus;
  for (std::size_t i = 0; i < places.size(); ++i)
    plateaus[i] = parts[nearest[corner_at(surface, places[i])]].plateau;
  return plateaus;
}

Field levelled(const Surface& surface, Field field, double low, double level, const OwnParts& parts,
               const std::vector<int>& nearest) {
  if (parts.size() < 2) return field;
  const Field before = field;
  for (Eigen::Index vertex = 0; vertex < field.size(); ++vertex)
    field[vertex] = low + (field[vertex] - low) / parts[nearest[vertex]].contrast;
  for (const std::vector<int>& found : superlevel_parts(surface, field, level)) {
    if (meets_any(parts, found)) continue;
    for (const int vertex : found) field[vertex] = std::min(field[vertex], before[vertex]);
  }
  return field;
}

}  // namespace palpation
