/// The laws of level loops on any surface, planar or not, checked by means that share nothing with
/// the library but the naming of places.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "palpation/boundary/level_set.h"

namespace palpation::testing {

/// A place by name: a vertex, named twice, or the one crossing of a mesh edge.
using PlaceName = std::pair<int, int>;
/// A directed piece by the names of its ends.
using PieceName = std::pair<PlaceName, PlaceName>;

inline PlaceName name_of(const Surface& surface, const SurfacePoint& point) {
  std::vector<int> held;
  for (int corner = 0; corner < 3; ++corner) {
    if (point.barycentric[corner] > 0.0) held.push_back(surface.triangle(point.face)[corner]);
  }
  std::sort(held.begin(), held.end());
  return {held.front(), held.back()};
}

inline bool at_vertex(const PlaceName& name) { return name.first == name.second; }

/// The level line by marching over the triangles: each crossed triangle gives one directed piece,
/// each border edge that is inside or in part another. Then what runs there and back is taken away.
class MarchedLine {
 public:
  MarchedLine(const Surface& surface, const Field& field, double level)
      : surface_(surface), field_(field), level_(level) {
    for (int face = 0; face < surface.face_count(); ++face) {
      march(face);
      for (int corner = 0; corner < 3; ++corner) {
        if (surface.neighbour(face, corner) < 0) follow_border(face, corner);
      }
    }
    cancel();
  }

  /// How often each directed piece is there: once, or the surface is two triangles back to back.
  const std::map<PieceName, int>& pieces() const { return pieces_; }
  const Vec3& place(const PlaceName& name) const { return places_.at(name); }

 private:
  bool inside(int vertex) const { return field_[vertex] >= level_; }

  PlaceName crossing(int a, int b) {
    if (a > b) std::swap(a, b);
    const int low = field_[a] < field_[b] ? a : b;
    const int high = low == a ? b : a;
    // Halves, so that no difference overflows; tiny values would lose a bit and need none.
    const bool large =
        std::max({std::abs(field_[a]), std::abs(field_[b]), std::abs(level_)}) > 1e300;
    const double part =
        large ? (0.5 * level_ - 0.5 * field_[low]) / (0.5 * field_[high] - 0.5 * field_[low])
              : (level_ - field_[low]) / (field_[high] - field_[low]);
    const Vec3 place = (1.0 - part) * surface_.vertex(low) + part * surface_.vertex(high);
    PlaceName name{a, b};
    if (part < 0x1p-60 || place == surface_.vertex(low)) name = {low, low};
    if (1.0 - part < 0x1p-60 || place == surface_.vertex(high)) name = {high, high};
    places_.emplace(name, at_vertex(name) ? surface_.vertex(name.first) : place);
    return name;
  }

  void march(int face) {
    const Eigen::Vector3i t = surface_.triangle(face);
    std::optional<PlaceName> from;
    std::optional<PlaceName> to;
    for (int corner = 0; corner < 3; ++corner) {
      const int a = t[corner];
      const int b = t[(corner + 1) % 3];
      if (inside(a) == inside(b)) continue;
      // Counter-clockwise around the face, the line leaves over the edge that goes in and enters
      // over the one that goes out.
      (inside(a) ? from : to) = crossing(a, b);
    }
    if (from) add(*from, *to);
  }

  void follow_border(int face, int corner) {
    const int a = surface_.triangle(face)[corner];
    const int b = surface_.triangle(face)[(corner + 1) % 3];
    if (!inside(a) && !inside(b)) return;
    places_.emplace(PlaceName{a, a}, surface_.vertex(a));
    places_.emplace(PlaceName{b, b}, surface_.vertex(b));
    add(inside(a) ? PlaceName{a, a} : crossing(a, b), inside(b) ? PlaceName{b, b} : crossing(a, b));
  }

  void add(const PlaceName& from, const PlaceName& to) {
    if (from != to) ++pieces_[{from, to}];
  }

  /// Whether both ends are on one mesh edge: only there can two pieces with the same ends be the
  /// same line.
  static bool along_an_edge(const PieceName& piece) {
    const std::set<int> vertices{piece.first.first, piece.first.second, piece.second.first,
                                 piece.second.second};
    return vertices.size() == 2;
  }

  void cancel() {
    for (auto& [piece, count] : pieces_) {
      if (!along_an_edge(piece)) continue;
      const auto back = pieces_.find({piece.second, piece.first});
      if (back == pieces_.end()) continue;
      const int both = std::min(count, back->second);
      count -= both;
      back->second -= both;
    }
    std::erase_if(pieces_, [](const auto& entry) { return entry.second == 0; });
  }

  const Surface& surface_;
  const Field& field_;
  double level_;
  std::map<PieceName, int> pieces_;
  std::map<PlaceName, Vec3> places_;
};

/// The area on the left of loops on any surface: faces that a piece crosses are cut along it; what
/// the rest is, whole faces inside or outside, spreads from there over edges without pieces.
/// `face_is_inside` is asked only for components that no loop and no border touches.
class AreaOnTheLeft {
 public:
  template <typename FaceIsInside>
  AreaOnTheLeft(const Surface& surface, const std::vector<LevelLoop>& loops,
                FaceIsInside face_is_inside)
      : surface_(surface), state_(surface.face_count(), kUnknown), cut_(surface.face_count()) {
    for (const LevelLoop& loop : loops) {
      for (std::size_t i = 0; i < loop.points.size(); ++i)
        take(loop.points[i], loop.points[(i + 1) % loop.points.size()]);
    }
    spread();
    for (int face = 0; face < surface.face_count(); ++face) {
      if (state_[face] != kUnknown) continue;
      put(face, touches_border(face) ? kOutside : (face_is_inside(face) ? kInside : kOutside));
      spread();
    }
  }

  const std::string& fault() const { return fault_; }

  double area() const {
    double sum = 0.0;
    for (int face = 0; face < surface_.face_count(); ++face) {
      if (state_[face] == kInside) sum += surface_.face_area(face);
      if (state_[face] == kCut) sum += share_on_the_left(*cut_[face]) * surface_.face_area(face);
    }
    return sum;
  }

 private:
  enum State { kUnknown, kInside, kOutside, kCut };

  /// Where on the way around the face a piece enters and leaves: corner k at k, the edge behind it
  /// up to k + 1.
  struct Cut {
    double entry;
    double exit;
    std::array<Vec3, 2> weights;  ///< of entry and exit
  };

  double along_rim(const Vec3& weights) const {
    for (int corner = 0; corner < 3; ++corner) {
      if (weights[(corner + 2) % 3] == 0.0 && weights[corner] > 0.0)
        return corner + weights[(corner + 1) % 3];
    }
    return 0.0;
  }

  /// The point's weights in a face that holds it.
  std::optional<Vec3> in_face(const SurfacePoint& point, int face) const {
    Vec3 weights = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      if (point.barycentric[corner] == 0.0) continue;
      int same = -1;
      for (int other = 0; other < 3; ++other) {
        if (surface_.triangle(face)[other] == surface_.triangle(point.face)[corner]) same = other;
      }
      if (same < 0) return std::nullopt;
      weights[same] = point.barycentric[corner];
    }
    return weights;
  }

  /// A piece runs in the face of its first point, as loops are promised to.
  void take(const SurfacePoint& from, const SurfacePoint& to) {
    const std::optional<Vec3> end = in_face(to, from.face);
    if (!end) {
      fault_ = "a piece leaves the face of its first point, " + std::to_string(from.face);
      return;
    }
    const PlaceName a = name_of(surface_, from);
    const PlaceName b = name_of(surface_, to);
    const std::set<int> vertices{a.first, a.second, b.first, b.second};
    if (vertices.size() == 2) {
      along_edge(from, *end, {*vertices.begin(), *vertices.rbegin()});
      return;
    }
    if (cut_[from.face]) fault_ = "two pieces cross face " + std::to_string(from.face);
    cut_[from.face] = Cut{along_rim(from.barycentric), along_rim(*end), {from.barycentric, *end}};
    put(from.face, kCut);
  }

  /// The face on the left is inside, the one on the right outside, as far as they are not cut
  /// themselves.
  void along_edge(const SurfacePoint& from, const Vec3& end, const std::pair<int, int>& edge) {
    const Eigen::Vector3i t = surface_.triangle(from.face);
    for (int corner = 0; corner < 3; ++corner) {
      const int next = (corner + 1) % 3;
      if (std::pair(std::min(t[corner], t[next]), std::max(t[corner], t[next])) != edge) continue;
      const bool forwards =
          end[next] - from.barycentric[next] > end[corner] - from.barycentric[corner];
      const int across = surface_.neighbour(from.face, corner);
      beside_.emplace_back(from.face, forwards ? kInside : kOutside);
      if (across >= 0) beside_.emplace_back(across, forwards ? kOutside : kInside);
      walls_.insert(edge);
    }
  }

  void put(int face, State state) {
    if (state_[face] == state) return;
    if (state_[face] == kCut) return;
    if (state_[face] != kUnknown && state != kCut) {
      fault_ = "face " + std::to_string(face) + " is inside and outside";
      return;
    }
    state_[face] = state;
    to_do_.push_back(face);
  }

  /// Whether the whole edge behind a corner of a cut face is on the left.
  static bool edge_on_the_left(const Cut& cut, int corner) {
    const int first = static_cast<int>(std::ceil(cut.exit));
    const int last = static_cast<int>(std::floor(cut.entry)) + (cut.entry > cut.exit ? 0 : 3);
    return (first <= corner && corner < last) || (first <= corner + 3 && corner + 3 < last);
  }

  static bool crosses(const Cut& cut, int corner) {
    return (cut.entry > corner && cut.entry < corner + 1) ||
           (cut.exit > corner && cut.exit < corner + 1);
  }

  void spread() {
    for (const auto& [face, state] : beside_) put(face, state);
    beside_.clear();
    while (!to_do_.empty()) {
      const int face = to_do_.front();
      to_do_.pop_front();
      for (int corner = 0; corner < 3; ++corner) {
        const int across = surface_.neighbour(face, corner);
        const int a = surface_.triangle(face)[corner];
        const int b = surface_.triangle(face)[(corner + 1) % 3];
        if (across < 0 || walls_.contains({std::min(a, b), std::max(a, b)})) continue;
        if (state_[face] != kCut) {
          put(across, state_[face]);
        } else if (!crosses(*cut_[face], corner)) {
          put(across, edge_on_the_left(*cut_[face], corner) ? kInside : kOutside);
        }
      }
    }
  }

  /// Of the component that the face is in.
  bool touches_border(int start) const {
    std::set<int> seen{start};
    std::vector<int> to_do{start};
    while (!to_do.empty()) {
      const int face = to_do.back();
      to_do.pop_back();
      for (int corner = 0; corner < 3; ++corner) {
        const int across = surface_.neighbour(face, corner);
        if (across < 0) return true;
        if (seen.insert(across).second) to_do.push_back(across);
      }
    }
    return false;
  }

  /// From the exit around the rim to the entry, in weights: the determinant of three places is
  /// their triangle's share of the face.
  static double share_on_the_left(const Cut& cut) {
    std::vector<Vec3> corners{cut.weights[1]};
    double end = cut.entry;
    while (end <= cut.exit) end += 3.0;
    for (int k = static_cast<int>(std::floor(cut.exit)) + 1; k < end; ++k)
      corners.push_back(Vec3::Unit(k % 3));
    corners.push_back(cut.weights[0]);
    double share = 0.0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      Eigen::Matrix3d triangle;
      triangle << corners[0], corners[i], corners[i + 1];
      share += triangle.determinant();
    }
    return share;
  }

  const Surface& surface_;
  std::vector<State> state_;
  std::vector<std::optional<Cut>> cut_;
  std::vector<std::pair<int, State>> beside_;
  std::set<std::pair<int, int>> walls_;
  std::deque<int> to_do_;
  std::string fault_;
};

/// What the laws say of the loops of one level set.
struct LoopReport {
  std::string fault;  ///< the first law that is broken, in words
  double area_difference =
      0.0;  ///< the loops' area less the sum over triangles, of the surface's area
  double shift =
      0.0;  ///< greatest distance of a point from where marching puts it, of the diameter
  int pieces = 0;
  int coincident = 0;  ///< pieces between places of different names but equal coordinates: across
                       ///< slivers thinner than doubles
};

/// Loops are closed chains of exactly the pieces that marching finds, each once; they visit no
/// place twice, come by falling length, and have the tissue of the triangles' sum on their left.
inline LoopReport report_on_loops(const Surface& surface, const Field& field, double level,
                                  const std::vector<LevelLoop>& loops) {
  LoopReport report;
  const auto broken = [&](const std::string& law) {
    if (report.fault.empty()) report.fault = law;
  };
  const MarchedLine marched(surface, field, level);
  std::map<PieceName, int> pieces;
  double last_length = std::numeric_limits<double>::infinity();
  for (const LevelLoop& loop : loops) {
    if (loop.points.size() != loop.on_border.size() || loop.points.size() < 2)
      broken("a loop has at least two points, each with its flag");
    std::set<PlaceName> visited;
    double length = 0.0;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const SurfacePoint& here = loop.points[i];
      const SurfacePoint& next = loop.points[(i + 1) % loop.points.size()];
      const PlaceName name = name_of(surface, here);
      if (!(here.barycentric.minCoeff() >= 0.0 && std::abs(here.barycentric.sum() - 1.0) <= 1e-15))
        broken("weights are fractions of one");
      if (!visited.insert(name).second) broken("a loop visits no place twice");
      ++pieces[{name, name_of(surface, next)}];
      const Vec3 step = surface.position(next) - surface.position(here);
      if (step == Vec3::Zero()) ++report.coincident;
      length += step.norm();
    }
    if (length > last_length * (1.0 + 1e-14)) broken("loops come by falling length");
    last_length = length;
    report.pieces += static_cast<int>(loop.points.size());
  }
  if (pieces != marched.pieces()) broken("loops are made of the pieces that marching finds");
  if (!report.fault.empty()) return report;

  for (const LevelLoop& loop : loops) {
    for (const SurfacePoint& point : loop.points) {
      const double shift =
          (surface.position(point) - marched.place(name_of(surface, point))).norm() /
          surface.diameter();
      report.shift = std::max(report.shift, shift);
    }
  }
  const AreaOnTheLeft left(surface, loops, [&](int face) {
    // No loop, so all but a trace of the component is on one side: that of the face's middle.
    long double middle = 0.0L;  // wide enough for three of the largest doubles
    for (const int vertex : surface.triangle(face))
      middle += static_cast<long double>(field[vertex]) - level;
    return middle >= 0.0L;
  });
  if (!left.fault().empty()) broken(left.fault());
  report.area_difference =
      std::abs(left.area() - superlevel_area(surface, field, level)) / surface.area();
  return report;
}

}  // namespace palpation::testing
