#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "io/polygon_soup.h"

namespace palpation {
namespace {

/// A side of a triangle: the edge between two vertices, low < high, and whether the triangle runs through it from low to high.
struct Side {
  int low, high, triangle;
  bool upward;
};

struct Neighbour {
  int triangle;
  bool agrees;  ///< the two run through their edge in opposite directions
};

/// Up to three neighbours of each triangle, across the edges that exactly two triangles share.
struct Adjacency {
  std::vector<std::array<Neighbour, 3>> neighbours;
  std::vector<int> counts;
  std::vector<bool> has_open_or_crowded_edge;
};

std::vector<Side> sorted_sides(const std::vector<SoupTriangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangles[t].corners[i], b = triangles[t].corners[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  return sides;
}

Adjacency adjacency_of(const std::vector<SoupTriangle>& triangles) {
  const std::vector<Side> sides = sorted_sides(triangles);
  Adjacency adjacency{std::vector<std::array<Neighbour, 3>>(triangles.size()), std::vector<int>(triangles.size(), 0),
                      std::vector<bool>(triangles.size(), false)};
  const auto connect = [&](const Side& from, const Side& to) {
    const auto t = static_cast<std::size_t>(from.triangle);
    adjacency.neighbours[t][static_cast<std::size_t>(adjacency.counts[t]++)] = {to.triangle, from.upward != to.upward};
  };
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    if (last - first == 2) {
      connect(sides[first], sides[first + 1]);
      connect(sides[first + 1], sides[first]);
    } else {
      for (std::size_t i = first; i < last; ++i) adjacency.has_open_or_crowded_edge[static_cast<std::size_t>(sides[i].triangle)] = true;
    }
  }
  return adjacency;
}

enum class Turn : char { Unknown, Keep, TurnRound };

struct Component {
  std::vector<int> triangles;
  bool orientable = true;
  bool closed = true;
};

/// Walks from the seed, breadth first, giving each triangle the turn that agrees with the one it was reached from.
Component spread(int seed, const Adjacency& adjacency, std::vector<Turn>& turns) {
  Component component;
  component.triangles.push_back(seed);
  turns[static_cast<std::size_t>(seed)] = Turn::Keep;
  for (std::size_t next = 0; next < component.triangles.size(); ++next) {
    const auto t = static_cast<std::size_t>(component.triangles[next]);
    if (adjacency.has_open_or_crowded_edge[t]) component.closed = false;
    for (int i = 0; i < adjacency.counts[t]; ++i) {
      const Neighbour& neighbour = adjacency.neighbours[t][static_cast<std::size_t>(i)];
      const Turn wanted = (turns[t] == Turn::Keep) == neighbour.agrees ? Turn::Keep : Turn::TurnRound;
      Turn& turn = turns[static_cast<std::size_t>(neighbour.triangle)];
      if (turn == Turn::Unknown) {
        turn = wanted;
        component.triangles.push_back(neighbour.triangle);
      } else if (turn != wanted) {
        component.orientable = false;
      }
    }
  }
  return component;
}

/// Turns the smaller part of a component; returns how many triangles were turned.
std::int64_t turn_fewest(const Component& component, const std::vector<Turn>& turns, std::vector<SoupTriangle>& triangles) {
  const auto turned = std::count_if(component.triangles.begin(), component.triangles.end(),
                                    [&](int t) { return turns[static_cast<std::size_t>(t)] == Turn::TurnRound; });
  const auto kept = static_cast<std::int64_t>(component.triangles.size()) - turned;
  const Turn minority = turned <= kept ? Turn::TurnRound : Turn::Keep;
  for (const int t : component.triangles) {
    if (turns[static_cast<std::size_t>(t)] == minority)
      std::swap(triangles[static_cast<std::size_t>(t)].corners[1], triangles[static_cast<std::size_t>(t)].corners[2]);
  }
  return std::min<std::int64_t>(turned, kept);
}

/// Six times the volume inside a closed component, seen from its first corner.
double volume_of(const Component& component, const std::vector<SoupTriangle>& triangles, const PolygonSoup& soup) {
  const auto point = [&](int t, std::size_t i) -> const Vec3& {
    return soup.points[static_cast<std::size_t>(triangles[static_cast<std::size_t>(t)].corners[i])];
  };
  const Vec3 origin = point(component.triangles.front(), 0);
  double volume = 0.0;
  for (const int t : component.triangles) volume += (point(t, 0) - origin).dot((point(t, 1) - origin).cross(point(t, 2) - origin));
  return volume;
}

}  // namespace

void orient_alike(std::vector<SoupTriangle>& triangles, const PolygonSoup& soup, std::vector<std::string>& warnings) {
  const Adjacency adjacency = adjacency_of(triangles);
  std::vector<Turn> turns(triangles.size(), Turn::Unknown);
  std::int64_t turned = 0;
  std::vector<int> one_sided, inside_out;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (turns[seed] != Turn::Unknown) continue;
    const Component component = spread(static_cast<int>(seed), adjacency, turns);
    if (!component.orientable) {
      one_sided.push_back(triangles[seed].face);
      continue;
    }
    turned += turn_fewest(component, turns, triangles);
    if (component.closed && volume_of(component, triangles, soup) < 0.0) inside_out.push_back(triangles[seed].face);
  }
  const auto say = [&](const std::vector<int>& faces, const std::string& what) {
    if (faces.empty()) return;
    warnings.push_back(std::to_string(faces.size()) + " of the components, such as that of face " +
                       std::to_string(faces.front() + soup.first_number) + ", " + what);
  };
  if (turned > 0) warnings.push_back(std::to_string(turned) + " triangles were turned round to agree with their neighbours.");
  say(one_sided, "cannot be oriented: no turning makes all neighbours agree.");
  say(inside_out, "are closed with faces that look inward: if tissue is inside, the normals point the wrong way.");
}

}  // namespace palpation
