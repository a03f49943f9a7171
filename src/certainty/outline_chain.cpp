#include "certainty/outline_chain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace palpation {
namespace {

/// Up to here moved pieces are asked one by one.
constexpr std::size_t kFew = 9;

struct MovedPiece {
  int node;       ///< its first
  Vec2 from, to;  ///< as it was
};

}  // namespace

/// What moves, and where it was.
struct OutlineChain::Step {
  const NodeLoop& loop;
  std::vector<int> nodes;          ///< that move
  std::vector<int> turning;        ///< at which the direction's turn may change
  std::vector<MovedPiece> pieces;  ///< that move
  Eigen::AlignedBox2d now, ever;   ///< of the pieces as they are; as they are and were

  bool moves_all() const { return static_cast<int>(nodes.size()) == loop.count; }
  bool moves(int piece) const {
    const int after_first = piece - pieces.front().node,
              steps = after_first < 0 ? after_first + loop.count : after_first;
    return piece >= loop.first && piece < loop.first + loop.count &&
           steps < static_cast<int>(pieces.size());
  }
};

OutlineChain::OutlineChain(const OutlineReadings& readings, const OutlinePrior& prior,
                           OutlineNodes start, OutlineProfile profile, const OutlineCuts& cuts,
                           const OutlineResiduals* residuals)
    : readings_(&readings),
      prior_(&prior),
      outline_(std::move(start)),
      pieces_(outline_),
      profile_(std::move(profile)),
      law_(law_of(profile_, prior)),
      taken_{.cuts = cuts},
      felt_(felt_at_start()),
      residuals_(residuals != nullptr ? *residuals : fresh_residuals()),
      nesting_(nesting_of(outline_)),
      held_(held_in(felt_)) {
  if (residuals != nullptr) {
    for (std::size_t i = 0; i < felt_.size(); ++i)
      residuals_.consider(i, off_from(i, felt_[i], law_));
    residuals_.keep();
  }
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    // The worse a reading fits, the likelier something is missing there.
    const double lacking = residuals_.lacking(i);
    taken_.anchors.push_back((i > 0 ? taken_.anchors.back() : 0.0) + 1.0 + lacking * lacking);
  }
  for (double& share : taken_.anchors) share /= taken_.anchors.back();
}

std::vector<OutlineChain::Felt> OutlineChain::felt_at_start() {
  for (int which = 0; which < kCuts; ++which) taken_.stadiums[which] = taken_.cuts[which].stadium();
  std::vector<Felt> felt;
  for (std::size_t i = 0; i < readings_->places.size(); ++i) felt.push_back(felt_anew(place_of(i)));
  return felt;
}

OutlineResiduals OutlineChain::fresh_residuals() const {
  std::vector<double> off;
  for (std::size_t i = 0; i < felt_.size(); ++i) off.push_back(off_from(i, felt_[i], law_));
  return {*readings_, std::move(off), prior_->residuals, 0.0};
}

int OutlineChain::epoch_of(std::size_t reading) const {
  return readings_->epoch.empty() ? 0 : readings_->epoch[reading];
}

/// Where it was made, as far as that is known.
Vec2 OutlineChain::place_of(std::size_t reading) const {
  Vec2 place = readings_->places[reading];
  for (const int change : prior_->epochs[epoch_of(reading)]) {
    const Vec2& moved_m = profile_.moved_m[change];
    place += prior_->changes[change] == MisfitKind::Late
                 ? Vec2(-moved_m.x() * readings_->travel[reading])
                 : moved_m;
  }
  if (const Wandering& wandering = profile_.wandering; !wandering.is_none())
    place += way_of(wandering, *readings_, static_cast<Eigen::Index>(reading));
  return place;
}

int OutlineChain::part_of(const Felt& felt) const {
  return outline_.loops[outline_.loop_of[felt.nearest.piece]].part;
}

double OutlineChain::depth_of(const Felt& felt) const {
  const double distance = std::sqrt(felt.nearest.square);
  double depth = felt.inside ? distance : -distance;
  for (int which = 0; which < kCuts; ++which) {
    if (taken_.cuts[which].is_present)
      depth = std::min(depth, -taken_.stadiums[which].depth_at(felt.place));
  }
  return depth;
}

/// How far it is off the profile.
double OutlineChain::off_from(std::size_t reading, const Felt& felt, const ReadingLaw& law) const {
  const double rise =
      law.gain[epoch_of(reading)] * law.contrast[part_of(felt)] * share_of_contrast(felt, law);
  return readings_->reading[reading] - law.low - rise;
}

/// Of its part's.
double OutlineChain::share_of_contrast(const Felt& felt, const ReadingLaw& law) const {
  if (!law.has_core(part_of(felt))) return felt.share;
  return share_by_core(law, felt.place, felt.depth_m, felt.share);
}

double OutlineChain::share_of(const Felt& felt, const ReadingLaw& law) const {
  return share_at(law, felt.depth_m, steepness_at(law, felt.place));
}

OutlineChain::Felt OutlineChain::felt_anew(const Vec2& place) const {
  return felt_at(place, pieces_.nearest(place), pieces_.encloses(place));
}

OutlineChain::Felt OutlineChain::felt_at(const Vec2& place, NearestPiece nearest,
                                         bool inside) const {
  Felt felt{.place = place, .nearest = nearest, .inside = inside};
  felt.depth_m = depth_of(felt);
  felt.share = share_of(felt, law_);
  return felt;
}

void OutlineChain::consider_none() {
  fresh_.clear();
  residuals_.forget();
}

void OutlineChain::consider(std::size_t reading, const Felt& felt, const ReadingLaw& law) {
  fresh_.emplace_back(reading, felt);
  residuals_.consider(reading, off_from(reading, felt, law));
}

bool OutlineChain::takes(double change, Random& random) {
  if (!(std::log(random.uniform()) < change + residuals_.change())) return false;
  std::vector<int> held = held_;
  for (const auto& [reading, felt] : fresh_) {
    if (const int loop = holder_of(felt_[reading]); loop >= 0) --held[loop];
    if (const int loop = holder_of(felt); loop >= 0) ++held[loop];
  }
  if (!may_hold(held)) return false;
  held_ = std::move(held);
  for (const auto& [reading, felt] : fresh_) felt_[reading] = felt;
  residuals_.keep();
  return true;
}

/// Of the nodes and the profile.
double OutlineChain::log_prior() const {
  return log_shape_density(outline_, profile_) + log_profile_density(profile_, *prior_);
}

double OutlineChain::log_density() const {
  double sum = log_prior() + residuals_.log_density();
  for (const OutlineCut& cut : taken_.cuts) sum += cut.is_present ? log_cut_density(cut) : 0.0;
  return sum;
}

double OutlineChain::shape_about(const Step& step) const {
  double sum = log_turns_density(outline_, step.turning.front(),
                                 static_cast<int>(step.turning.size()), profile_);
  const double log_spacing = profile_.log_spacing[outline_.loop_of[step.nodes.front()]];
  for (const MovedPiece& piece : step.pieces)
    sum += log_length_density(outline_.place[piece.node], outline_.place[outline_.next(piece.node)],
                              log_spacing);
  return sum;
}

bool OutlineChain::crosses_another(const Step& step) const {
  for (int other = 0; other < outline_.count(); ++other) {
    const int after = outline_.next(other);
    const Vec2 &from = outline_.place[other], &to = outline_.place[after];
    if (!step.now.intersects(Eigen::AlignedBox2d(from.cwiseMin(to), from.cwiseMax(to)))) continue;
    for (const MovedPiece& piece : step.pieces) {
      const int end = outline_.next(piece.node);
      const bool is_neighbour = other == piece.node || other == end || after == piece.node;
      if (is_neighbour || (step.moves(other) && other < piece.node)) continue;
      if (cross_each_other(outline_.place[piece.node], outline_.place[end], from, to)) return true;
    }
  }
  return false;
}

/// Without a crossing a loop passes over another only as a whole, or over a whole one.
bool OutlineChain::may_swallow(const Step& step) const {
  return step.moves_all() || std::ranges::any_of(outline_.loops, [&](const NodeLoop& other) {
           return other.first != step.loop.first && step.ever.contains(outline_.place[other.first]);
         });
}

/// Neither which side it lies on nor what is nearest to it can have changed.
bool OutlineChain::is_untouched(const Step& step, std::size_t reading) const {
  const Vec2& place = felt_[reading].place;
  const NearestPiece& nearest = felt_[reading].nearest;
  return !step.moves(nearest.piece) && !step.ever.contains(place) &&
         step.now.squaredExteriorDistance(place) > nearest.square;
}

OutlineChain::Felt OutlineChain::felt_after(const Step& step, std::size_t reading) const {
  const Vec2& place = felt_[reading].place;
  if (step.pieces.size() > kFew) return felt_anew(place);
  auto [nearest, inside] = std::pair(felt_[reading].nearest, felt_[reading].inside);
  const bool may_flip = step.ever.contains(place);
  NearestPiece moved{.square = 1e300};
  for (const MovedPiece& piece : step.pieces) {
    const Vec2 &from = outline_.place[piece.node], &to = outline_.place[outline_.next(piece.node)];
    if (may_flip)
      inside ^= crosses_ray(place, piece.from, piece.to) != crosses_ray(place, from, to);
    const double square = squared_distance(place, from, to);
    if (square < moved.square) moved = {square, piece.node};
  }
  if (moved.square <= nearest.square) {
    nearest = moved;
  } else if (step.moves(nearest.piece)) {
    nearest = pieces_.nearest(place);
  }
  return felt_at(place, nearest, inside);
}

OutlineChain::Step OutlineChain::step_from(int first, int moved) const {
  const NodeLoop& loop = outline_.loops[outline_.loop_of[first]];
  Step step{.loop = loop, .nodes = {}, .turning = {}, .pieces = {}, .now = {}, .ever = {}};
  int node = first;
  for (int i = 0; i < moved; ++i, node = outline_.next(node)) step.nodes.push_back(node);
  const bool moves_all = moved == loop.count;
  node = moves_all ? first : outline_.before(first);
  for (int i = 0; i < std::min(moved + 2, loop.count); ++i, node = outline_.next(node)) {
    step.turning.push_back(node);
    if (i <= moved)
      step.pieces.push_back({node, outline_.place[node], outline_.place[outline_.next(node)]});
  }
  return step;
}

/// In two stages, each of which leaves its part of the density in balance: first the shape's,
/// which costs little, then the readings' (Christen and Fox 2005).
bool OutlineChain::move_nodes(int first, const std::vector<Vec2>& places, Random& random,
                              double log_volume) {
  Step step = step_from(first, static_cast<int>(places.size()));
  const double before = shape_about(step);
  for (std::size_t i = 0; i < places.size(); ++i) outline_.place[step.nodes[i]] = places[i];
  const bool taken =
      std::log(random.uniform()) < shape_about(step) - before + log_volume && feel(step, random);
  if (!taken) {
    for (const MovedPiece& piece : step.pieces) outline_.place[piece.node] = piece.from;
  }
  return taken;
}

/// Whether a step whose nodes have moved is taken for what the readings say.
bool OutlineChain::feel(Step& step, Random& random) {
  for (const MovedPiece& piece : step.pieces) {
    const Vec2 &from = outline_.place[piece.node], &to = outline_.place[outline_.next(piece.node)];
    pieces_.set(piece.node, from, to);
    step.now.extend(from).extend(to);
    step.ever.extend(piece.from).extend(piece.to);
  }
  step.ever.extend(step.now);
  bool taken = !crosses_another(step) && (!may_swallow(step) || is_nested_as_before());
  if (taken) {
    consider_none();
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      if (!is_untouched(step, i)) consider(i, felt_after(step, i), law_);
    }
    taken = takes(0.0, random);
  }
  if (!taken) {
    for (const MovedPiece& piece : step.pieces) pieces_.set(piece.node, piece.from, piece.to);
  }
  return taken;
}

}  // namespace palpation
