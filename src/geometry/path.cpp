#include "palpation/geometry/path.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/unfolding.h"
#include "palpation/base/error.h"
#include "palpation/geometry/distance.h"

namespace palpation {
namespace {

/// Nearer to the cutting plane than this share of the way's length is in it.
constexpr double kThickness = 1e-9;

/// Vertices in the plane count as lying on one side of it, so that the way passes each of them on a
/// known side. Along a border only one choice leads through tissue.
enum class InPlane { Front, Behind };

class SectionWalk {
 public:
  SectionWalk(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
              InPlane in_plane)
      : surface_(surface),
        to_(to),
        in_plane_(in_plane),
        start_(surface.position(from)),
        travel_(surface.position(to) - start_) {
    const Vec3 normal = surface.normal(from) + surface.normal(to);
    plane_ = normal.cross(travel_);
  }

  /// The pieces from start to end, or nothing if the cut does not lead there.
  std::optional<std::vector<Piece>> walk(const SurfacePoint& from) {
    if (plane_.norm() == 0.0) return std::nullopt;
    std::optional<Exit> exit;
    int face = -1;
    for (int candidate : faces_around(from)) {
      if (reaches_end(candidate))
        return std::vector<Piece>{
            {candidate, weights_in(candidate, from), weights_in(candidate, to_)}};
      const std::optional<Exit> here = forward_exit(candidate);
      if (here && (!exit || here->progress > exit->progress)) {
        exit = here;
        face = candidate;
      }
    }
    std::vector<Piece> pieces;
    Vec3 entry = exit ? weights_in(face, from) : Vec3::Zero();
    while (exit && static_cast<int>(pieces.size()) <= surface_.face_count()) {
      pieces.push_back({face, entry, exit->weights});
      const int next = surface_.neighbour(face, exit->edge);
      if (next < 0) return std::nullopt;
      entry = carried_over(face, exit->weights, next);
      if (reaches_end(next)) {
        pieces.push_back({next, entry, weights_in(next, to_)});
        return pieces;
      }
      exit = exit_other_than(next, face);
      face = next;
    }
    return std::nullopt;
  }

 private:
  struct Exit {
    int edge;         // from corner edge to corner edge + 1
    Vec3 weights;     // where it is crossed
    double progress;  // along the straight line
  };

  Eigen::Vector3d sides(int face) const {
    Eigen::Vector3d side;
    for (int corner = 0; corner < 3; ++corner) {
      side[corner] = plane_.dot(surface_.vertex(surface_.triangle(face)[corner]) - start_);
      if (std::abs(side[corner]) <= kThickness * plane_.norm() * travel_.norm()) side[corner] = 0.0;
    }
    return side;
  }

  bool in_front(double side) const {
    return side > 0.0 || (side == 0.0 && in_plane_ == InPlane::Front);
  }

  /// Where the plane crosses an edge, if it does; a vertex in the plane counts as in front, so that
  /// the way passes every vertex on one side.
  std::optional<Exit> crossing(int face, int edge) const {
    const Eigen::Vector3d side = sides(face);
    const int next = (edge + 1) % 3;
    if (in_front(side[edge]) == in_front(side[next])) return std::nullopt;
    Vec3 weights = Vec3::Zero();
    weights[next] = side[edge] / (side[edge] - side[next]);
    weights[edge] = 1.0 - weights[next];
    return Exit{edge, weights, (surface_.position({face, weights}) - start_).dot(travel_)};
  }

  std::optional<Exit> forward_exit(int face) const {
    std::optional<Exit> best;
    for (int edge = 0; edge < 3; ++edge) {
      const std::optional<Exit> here = crossing(face, edge);
      if (here && here->progress > 0.0 && (!best || here->progress > best->progress)) best = here;
    }
    return best;
  }

  std::optional<Exit> exit_other_than(int face, int came_from) const {
    for (int edge = 0; edge < 3; ++edge) {
      if (surface_.neighbour(face, edge) == came_from) continue;
      if (const std::optional<Exit> here = crossing(face, edge)) return here;
    }
    return std::nullopt;
  }

  /// The faces that a place belongs to: several for a vertex.
  std::vector<int> faces_around(const SurfacePoint& point) const {
    for (int corner = 0; corner < 3; ++corner) {
      if (point.barycentric[corner] == 1.0) return fan(point.face, corner);
    }
    return {point.face};
  }

  std::vector<int> fan(int face, int corner) const {
    const int vertex = surface_.triangle(face)[corner];
    std::vector<int> faces{face};
    for (const bool forward : {true, false}) {
      int current = face;
      while (true) {
        const int at = corner_of(current, vertex);
        current = surface_.neighbour(current, forward ? (at + 2) % 3 : at);
        if (current < 0) break;
        if (current == face) return faces;
        faces.push_back(current);
      }
    }
    return faces;
  }

  int corner_of(int face, int vertex) const {
    for (int corner = 0; corner < 3; ++corner) {
      if (surface_.triangle(face)[corner] == vertex) return corner;
    }
    return -1;
  }

  bool reaches_end(int face) const {
    if (face == to_.face) return true;
    for (int corner = 0; corner < 3; ++corner) {
      if (to_.barycentric[corner] == 1.0)
        return corner_of(face, surface_.triangle(to_.face)[corner]) >= 0;
    }
    return false;
  }

  /// The weights of a point in a face that contains it.
  Vec3 weights_in(int face, const SurfacePoint& point) const {
    return carried_over(point.face, point.barycentric, face);
  }

  Vec3 carried_over(int face, const Vec3& weights, int other) const {
    if (face == other) return weights;
    Vec3 result = Vec3::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      const int there = corner_of(other, surface_.triangle(face)[corner]);
      if (there >= 0) result[there] = weights[corner];
    }
    return result;
  }

  const Surface& surface_;
  SurfacePoint to_;
  InPlane in_plane_;
  Vec3 start_, travel_, plane_;
};

std::vector<SurfacePoint> spaced_along(const Surface& surface, const std::vector<Piece>& pieces,
                                       double step_m) {
  std::vector<SurfacePoint> places;
  double to_next = step_m;
  double total = 0.0;
  for (const Piece& piece : pieces) {
    const double length =
        (surface.position({piece.face, piece.to}) - surface.position({piece.face, piece.from}))
            .norm();
    total += length;
    double done = 0.0;
    while (length - done >= to_next) {
      done += to_next;
      to_next = step_m;
      const double fraction = done / length;
      places.push_back({piece.face, (1.0 - fraction) * piece.from + fraction * piece.to});
    }
    to_next -= length - done;
  }
  // The end itself is a stop, not a place on the way.
  if (!places.empty() && total - step_m * static_cast<double>(places.size()) < 1e-6 * step_m)
    places.pop_back();
  return places;
}

std::vector<SurfacePoint> projected_line(const Surface& surface, const SurfacePoint& from,
                                         const SurfacePoint& to, double step_m) {
  const Vec3 start = surface.position(from);
  const Vec3 travel = surface.position(to) - start;
  std::vector<SurfacePoint> places;
  for (int i = 1; i * step_m < travel.norm() * (1.0 - 1e-9); ++i)
    places.push_back(surface.project(start + travel * (i * step_m / travel.norm())));
  return places;
}

double length_of(const Surface& surface, const std::vector<Piece>& pieces) {
  double length = 0.0;
  for (const Piece& piece : pieces)
    length +=
        (surface.position({piece.face, piece.to}) - surface.position({piece.face, piece.from}))
            .norm();
  return length;
}

/// Not less than the length of the shortest path, and not much more: what a plane through both
/// places and their normals cuts out where that is almost straight, else the fast estimate.
double length_at_most(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to) {
  constexpr double kAlmostStraight = 1.1, kRounding = 1.0 + 1e-9, kSlack = 1.02;
  const double straight = (surface.position(to) - surface.position(from)).norm();
  if (const auto pieces = SectionWalk(surface, from, to, InPlane::Front).walk(from)) {
    const double length = length_of(surface, *pieces);
    if (length <= kAlmostStraight * straight) return kRounding * length;
  }
  const std::array<SurfacePoint, 2> ends = {from, to};
  return kSlack * distances_between(surface, ends)(0, 1);
}

/// The shortest path, looked for among ways not much longer first.
std::optional<ShortestPath> shortest_path(const Surface& surface, const SurfacePoint& from,
                                          const SurfacePoint& to) {
  if (const auto path = unfolded_path(surface, from, to, length_at_most(surface, from, to)))
    return path;
  return unfolded_path(surface, from, to);
}

}  // namespace

std::vector<SurfacePoint> way_between(const Surface& surface, const SurfacePoint& from,
                                      const SurfacePoint& to, double step_m) {
  require(std::isfinite(step_m) && step_m > 0.0, "way_between", "step_m = " + text_of(step_m),
          "must be positive and finite");
  if (surface.is_planar()) {
    if ((surface.position(to) - surface.position(from)).norm() <= step_m) return {};
    for (const InPlane choice : {InPlane::Front, InPlane::Behind}) {
      if (const auto pieces = SectionWalk(surface, from, to, choice).walk(from))
        return spaced_along(surface, *pieces, step_m);
    }
  }
  if (const auto path = shortest_path(surface, from, to))
    return spaced_along(surface, path->pieces, step_m);
  return projected_line(surface, from, to, step_m);
}

}  // namespace palpation
