/// How a walk moves a polygon's sides and corners: many nodes at once, or all but one would turn
/// where they do not.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "certainty/outline_walk.h"

namespace palpation {
namespace {

constexpr double kCornerTurn = 0.4;  ///< radians, and more
constexpr int kLongestSide = 24;     ///< pieces
constexpr int kMostCut = 9,
              kOfSide = 2;              ///< pieces that are cut off; of a side, which tell its way
constexpr int kFewest = 2, kMost = 10;  ///< pieces on either side of a corner that nodes pass
constexpr double kFarthest_m = 0.004, kShortest_m = 3e-5;
constexpr double kParallel = 0.2;  ///< sine of the angle

/// Of the node's loop, so many on.
int node_on(const OutlineNodes& outline, int node, int steps) {
  const NodeLoop& loop = outline.loops[outline.loop_of[node]];
  return loop.first + ((node - loop.first + steps) % loop.count + loop.count) % loop.count;
}

/// How many pieces from there, this way, the next corner is; no more than a side may have.
int pieces_to_corner(const OutlineNodes& outline, int node, int way) {
  const int most = std::min(kLongestSide, outline.loops[outline.loop_of[node]].count / 2 - 1);
  for (int pieces = 1; pieces < most; ++pieces) {
    const int on = node_on(outline, node, way * pieces);
    if (std::abs(turn_at(outline, on)) > kCornerTurn) return pieces;
  }
  return most;
}

/// A side as far as it goes, on which the line goes on beyond its end.
struct Side {
  Vec2 end, way;
};

/// Where both would meet, if that is not far.
std::optional<Vec2> meeting_of(const Side& side, const Side& other) {
  const double across = cross(side.way, other.way), length = side.way.norm(),
               other_length = other.way.norm();
  if (std::abs(across) < kParallel * length * other_length) return std::nullopt;
  const Vec2 apart = other.end - side.end;
  const double on = cross(apart, other.way) / across, other_on = cross(apart, side.way) / across;
  if (std::min(on, other_on) <= 0.0 || on * length > kFarthest_m ||
      other_on * other_length > kFarthest_m)
    return std::nullopt;
  return side.end + on * side.way;
}

/// What lies so far along the line from there to the tip and on to its end.
Vec2 on_tip(const Vec2& from, const Vec2& tip, const Vec2& to, double part) {
  const double first = (tip - from).norm(), second = (to - tip).norm(),
               gone = part * (first + second);
  return gone < first ? Vec2(from + gone / first * (tip - from))
                      : Vec2(tip + (gone - first) / second * (to - tip));
}

}  // namespace

void OutlineWalk::move_sides() {
  const int count = chain_.outline().count();
  for (int i = 0; i < count / 2; ++i) {
    move_corner(random_.below(count));
    pass_corner(random_.below(count));
    cut_or_point(random_.below(count));
  }
}

/// Any node, and with it the line on either side as far as the next corner, which goes straight on
/// if it was straight. As likely as back, as long as the corners stay where they are.
void OutlineWalk::move_corner(int node) {
  const OutlineNodes& outline = chain_.outline();
  const int before = pieces_to_corner(outline, node, -1),
            after = pieces_to_corner(outline, node, 1);
  const double length = kShortest_m * std::pow(kFarthest_m / kShortest_m, random_.uniform());
  const Vec2 way = length * random_.normal() * direction_of(random_);
  std::vector<Vec2> places;
  OutlineNodes moved = outline;
  for (int i = 1 - before; i < after; ++i) {
    const double part =
        1.0 - (i < 0 ? -i / static_cast<double>(before) : i / static_cast<double>(after));
    places.push_back(moved.place[node_on(outline, node, i)] += part * way);
  }
  if (pieces_to_corner(moved, node, -1) != before || pieces_to_corner(moved, node, 1) != after)
    return;
  chain_.move_nodes(node_on(outline, node, 1 - before), places, random_);
}

/// The node after it, or before it, is the corner, which stays where it is, and all between two
/// others are as far apart as before: so a side that grows gets nodes of one that shrinks. How far
/// nodes lie off the straight lines stays as it is, that of the new corner's for the old one's.
void OutlineWalk::pass_corner(int node) {
  const OutlineNodes& outline = chain_.outline();
  const int before = kFewest + random_.below(kMost - kFewest + 1),
            after = kFewest + random_.below(kMost - kFewest + 1),
            step = random_.uniform() < 0.5 ? 1 : -1;
  if (std::min(before + step, after - step) < kFewest ||
      std::max(before + step, after - step) > kMost ||
      before + after + 2 > outline.loops[outline.loop_of[node]].count)
    return;
  const auto place = [&](int i) -> const Vec2& { return outline.place[node_on(outline, node, i)]; };
  const auto on_lines = [&, from = place(-before), to = place(after)](int i, int corner) -> Vec2 {
    const Vec2 &end = i < corner ? from : to, &at = place(0);
    const double pieces = i < corner ? before + corner : after - corner;
    return at + std::abs(i - corner) / pieces * (end - at);
  };
  std::vector<Vec2> places;
  for (int i = 1 - before; i < after; ++i) {
    const int was = i == 0 ? step : i;
    places.push_back(i == step ? place(0) : on_lines(i, step) + place(was) - on_lines(was, 0));
  }
  chain_.move_nodes(node_on(outline, node, 1 - before), places, random_);
}

/// What lies on the chord over some pieces from the node on goes to the tip at which the sides on
/// both ends would meet, or back, and scales as the line's length does: what the sides beyond the
/// chord say does not depend on the nodes that move.
void OutlineWalk::cut_or_point(int node) {
  const OutlineNodes& outline = chain_.outline();
  const int pieces = 2 + random_.below(kMostCut - 1);
  const bool points = random_.uniform() < 0.5;
  if (pieces + 2 * kOfSide + 2 > outline.loops[outline.loop_of[node]].count) return;
  const int end = node_on(outline, node, pieces);
  const Vec2 &from = outline.place[node], &to = outline.place[end];
  const std::optional<Vec2> tip =
      meeting_of({from, from - outline.place[node_on(outline, node, -kOfSide)]},
                 {to, to - outline.place[node_on(outline, end, kOfSide)]});
  if (!tip) return;
  const double longer = ((*tip - from).norm() + (to - *tip).norm()) / (to - from).norm(),
               scale = points ? longer : 1.0 / longer;
  std::vector<Vec2> places;
  for (int i = 1; i < pieces; ++i) {
    const double part = i / static_cast<double>(pieces);
    const Vec2 pointed = on_tip(from, *tip, to, part), cut = from + part * (to - from),
               off = outline.place[node_on(outline, node, i)] - (points ? cut : pointed);
    places.push_back((points ? pointed : cut) + scale * off);
  }
  chain_.move_nodes(node_on(outline, node, 1), places, random_,
                    2.0 * (pieces - 1.0) * std::log(scale));
}

}  // namespace palpation
