#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "io/bucket_sort.h"
#include "io/polygon_soup.h"

namespace palpation {
namespace {

/// Side 3 t + i runs from corner i to corner i + 1 of triangle t; low and high are the vertices of
/// its edge.
class Sides {
 public:
  explicit Sides(const std::vector<SoupTriangle>& triangles) : triangles_(triangles) {}
  std::size_t count() const { return 3 * triangles_.size(); }
  static std::size_t triangle(int side) { return static_cast<std::size_t>(side) / 3; }
  int low(int side) const { return std::min(start(side), end(side)); }
  int high(int side) const { return std::max(start(side), end(side)); }
  bool upward(int side) const { return start(side) < end(side); }
  bool share_edge(int a, int b) const { return low(a) == low(b) && high(a) == high(b); }

 private:
  int start(int side) const {
    return triangles_[triangle(side)].corners[static_cast<std::size_t>(side) % 3];
  }
  int end(int side) const {
    return triangles_[triangle(side)].corners[(static_cast<std::size_t>(side) + 1) % 3];
  }

  const std::vector<SoupTriangle>& triangles_;
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

/// Sides of the same edge one after the other, in the order of their triangles.
std::vector<int> by_edge(const Sides& sides, std::size_t point_count) {
  std::vector<int> numbers(sides.count());
  std::iota(numbers.begin(), numbers.end(), 0);
  return sorted_in_buckets(
      numbers, point_count, [&](int side) { return static_cast<std::size_t>(sides.low(side)); },
      [&](int a, int b) {
        const int high_a = sides.high(a), high_b = sides.high(b);
        return high_a != high_b ? high_a < high_b : a < b;
      });
}

Adjacency adjacency_of(const std::vector<SoupTriangle>& triangles, std::size_t point_count) {
  const Sides sides(triangles);
  const std::vector<int> sorted = by_edge(sides, point_count);
  Adjacency adjacency{std::vector<std::array<Neighbour, 3>>(triangles.size()),
                      std::vector<int>(triangles.size(), 0),
                      std::vector<bool>(triangles.size(), false)};
  const auto connect = [&](int from, int to) {
    const std::size_t t = Sides::triangle(from);
    adjacency.neighbours[t][adjacency.counts[t]++] = {static_cast<int>(Sides::triangle(to)),
                                                      sides.upward(from) != sides.upward(to)};
  };
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && sides.share_edge(sorted[first], sorted[last])) ++last;
    if (last - first == 2) {
      connect(sorted[first], sorted[first + 1]);
      connect(sorted[first + 1], sorted[first]);
    } else {
      for (std::size_t i = first; i < last; ++i)
        adjacency.has_open_or_crowded_edge[Sides::triangle(sorted[i])] = true;
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

/// Walks from the seed, breadth first, giving each triangle the turn that agrees with the one it
/// was reached from.
Component spread(int seed, const Adjacency& adjacency, std::vector<Turn>& turns) {
  Component component;
  component.triangles.push_back(seed);
  turns[seed] = Turn::Keep;
  for (std::size_t next = 0; next < component.triangles.size(); ++next) {
    const auto t = static_cast<std::size_t>(component.triangles[next]);
    if (adjacency.has_open_or_crowded_edge[t]) component.closed = false;
    for (int i = 0; i < adjacency.counts[t]; ++i) {
      const Neighbour& neighbour = adjacency.neighbours[t][i];
      const Turn wanted =
          (turns[t] == Turn::Keep) == neighbour.agrees ? Turn::Keep : Turn::TurnRound;
      Turn& turn = turns[neighbour.triangle];
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
std::int64_t turn_fewest(const Component& component, const std::vector<Turn>& turns,
                         std::vector<SoupTriangle>& triangles) {
  const auto turned = std::count_if(component.triangles.begin(), component.triangles.end(),
                                    [&](int t) { return turns[t] == Turn::TurnRound; });
  const auto kept = static_cast<std::int64_t>(component.triangles.size()) - turned;
  const Turn minority = turned <= kept ? Turn::TurnRound : Turn::Keep;
  for (const int t : component.triangles) {
    if (turns[t] == minority) std::swap(triangles[t].corners[1], triangles[t].corners[2]);
  }
  return std::min<std::int64_t>(turned, kept);
}

/// Six times the volume inside a closed component, seen from its first corner.
double volume_of(const Component& component, const std::vector<SoupTriangle>& triangles,
                 const PolygonSoup& soup) {
  const auto point = [&](int t, std::size_t i) -> const Vec3& {
    return soup.points[triangles[t].corners[i]];
  };
  const Vec3 origin = point(component.triangles.front(), 0);
  double volume = 0.0;
  for (const int t : component.triangles)
    volume += (point(t, 0) - origin).dot((point(t, 1) - origin).cross(point(t, 2) - origin));
  return volume;
}

}  // namespace

void orient_alike(std::vector<SoupTriangle>& triangles, PolygonSoup& soup) {
  const Adjacency adjacency = adjacency_of(triangles, soup.points.size());
  std::vector<Turn> turns(triangles.size(), Turn::Unknown);
  std::int64_t turned = 0, components = 0;
  std::vector<int> one_sided, inside_out;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (turns[seed] != Turn::Unknown) continue;
    ++components;
    const Component component = spread(static_cast<int>(seed), adjacency, turns);
    if (!component.orientable) {
      one_sided.push_back(triangles[seed].face);
      continue;
    }
    turned += turn_fewest(component, turns, triangles);
    if (component.closed && volume_of(component, triangles, soup) < 0.0)
      inside_out.push_back(triangles[seed].face);
  }
  const auto say = [&](const std::vector<int>& faces, const std::string& what,
                       const std::string& advice) {
    if (faces.empty()) return;
    soup.warn(std::to_string(faces.size()) + " of the components, such as that of face " +
                  std::to_string(faces.front() + soup.first_number) + ", " + what,
              advice);
  };
  if (components > 1) {
    soup.warn("The mesh is in " + std::to_string(components) + " components, which share no edge.",
              "Nothing is known across a gap. Delete what is not tissue; if they should be one, "
              "weld their seams.");
  }
  if (turned > 0) {
    soup.warn(std::to_string(turned) + (turned == 1 ? " triangle was" : " triangles were") +
                  " turned round to agree with their neighbours.",
              "Nothing to do, so long as the outside is where it should be.");
  }
  say(one_sided, "cannot be oriented: no turning makes all neighbours agree.",
      "A surface with one side (a Moebius strip) has no outside to touch. Delete the faces where "
      "it closes on itself.");
  say(inside_out,
      "are closed with faces that look inward: if tissue is inside, the normals point the wrong "
      "way.",
      "The probe would come from inside. Flip all faces in a mesh editor.");
}

}  // namespace palpation
