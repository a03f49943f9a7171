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

  bool moves(int piece) const {
    const int after_first = piece - pieces.front().node,
              steps = after_first < 0 ? after_first + loop.count : after_first;
    return piece >= loop.first && piece < loop.first + loop.count &&
           steps < static_cast<int>(pieces.size());
  }
};

OutlineChain::OutlineChain(const OutlineReadings& readings, const OutlinePrior& prior,
                           OutlineNodes start, OutlineProfile profile, const Cuts& cuts,
                           const OutlineBackground* background)
    : readings_(&readings),
      prior_(&prior),
      outline_(std::move(start)),
      pieces_(outline_),
      profile_(std::move(profile)),
      law_(law_of(profile_, prior)),
      background_(background != nullptr ? *background : OutlineBackground(readings.background)),
      cuts_(cuts),
      felt_(readings.places.size()) {
  for (int which = 0; which < kCuts; ++which) stadiums_[which] = cuts_[which].stadium();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const Vec2& place = readings_->places[i];
    felt_[i] = felt_at(i, pieces_.nearest(place), pieces_.encloses(place));
    // The worse a reading fits, the likelier something is missing there.
    const double best = log_likelihood(law_, law_.low, readings_->variance[i], 0.0),
                 lacking = best - felt_[i].log_likelihood;
    anchors_.push_back((i > 0 ? anchors_.back() : 0.0) + 1.0 + lacking * lacking);
  }
  for (double& share : anchors_) share /= anchors_.back();
}

int OutlineChain::part_of(const Felt& felt) const {
  return outline_.loops[outline_.loop_of[felt.nearest.piece]].part;
}

double OutlineChain::depth_of(std::size_t reading, const Felt& felt) const {
  const double distance = std::sqrt(felt.nearest.square);
  double depth = felt.inside ? distance : -distance;
  for (int which = 0; which < kCuts; ++which) {
    if (cuts_[which].is_present)
      depth = std::min(depth, -stadiums_[which].depth_at(readings_->places[reading]));
  }
  return depth;
}

double OutlineChain::likelihood_of(std::size_t reading, const Felt& felt,
                                   const ReadingLaw& law) const {
  const double rise = law.contrast[part_of(felt)] * felt.share;
  return log_likelihood(law, readings_->reading[reading] - background_.at(reading),
                        readings_->variance[reading], rise);
}

OutlineChain::Felt OutlineChain::felt_at(std::size_t reading, NearestPiece nearest,
                                         bool inside) const {
  Felt felt{.nearest = nearest, .inside = inside};
  felt.depth_m = depth_of(reading, felt);
  felt.share = share_at(law_, felt.depth_m);
  felt.log_likelihood = likelihood_of(reading, felt, law_);
  return felt;
}

double OutlineChain::consider(std::size_t reading, const Felt& felt) {
  fresh_.emplace_back(reading, felt);
  return felt.log_likelihood - felt_[reading].log_likelihood;
}

void OutlineChain::keep_fresh() {
  for (const auto& [reading, felt] : fresh_) felt_[reading] = felt;
}

double OutlineChain::log_density() const {
  double sum = log_shape_density(outline_, profile_) + log_profile_density(profile_, *prior_) +
               background_.log_density();
  for (const Felt& felt : felt_) sum += felt.log_likelihood;
  for (const OutlineCut& cut : cuts_) sum += cut.is_present ? log_cut_density(cut) : 0.0;
  return sum;
}

double OutlineChain::shape_about(const Step& step) const {
  double sum = 0.0;
  for (const int node : step.turning)
    sum += log_turn_density(step.loop, outline_.place[outline_.before(node)], outline_.place[node],
                            outline_.place[outline_.next(node)], profile_);
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

/// Neither which side it lies on nor what is nearest to it can have changed.
bool OutlineChain::is_untouched(const Step& step, std::size_t reading) const {
  const Vec2& place = readings_->places[reading];
  const NearestPiece& nearest = felt_[reading].nearest;
  return !step.moves(nearest.piece) && !step.ever.contains(place) &&
         step.now.squaredExteriorDistance(place) > nearest.square;
}

OutlineChain::Felt OutlineChain::felt_after(const Step& step, std::size_t reading) const {
  const Vec2& place = readings_->places[reading];
  if (step.pieces.size() > kFew)
    return felt_at(reading, pieces_.nearest(place), pieces_.encloses(place));
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
  return felt_at(reading, nearest, inside);
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
  double change = 0.0;
  bool taken = !crosses_another(step);
  if (taken) {
    fresh_.clear();
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      if (!is_untouched(step, i)) change += consider(i, felt_after(step, i));
    }
    taken = std::log(random.uniform()) < change;
  }
  if (!taken) {
    for (const MovedPiece& piece : step.pieces) pieces_.set(piece.node, piece.from, piece.to);
  }
  if (taken) keep_fresh();
  return taken;
}

/// Of the readings' part of the density; the rest has changed by `change`. Few readings lie any
/// deeper or less deep for a cut.
bool OutlineChain::try_cut(int which, const OutlineCut& cut, double change, Random& random) {
  const OutlineCut before = std::exchange(cuts_[which], cut);
  const Stadium stadium_before = std::exchange(stadiums_[which], cut.stadium());
  fresh_.clear();
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    if (depth_of(i, felt_[i]) != felt_[i].depth_m)
      change += consider(i, felt_at(i, felt_[i].nearest, felt_[i].inside));
  }
  const bool taken = std::log(random.uniform()) < change;
  if (taken) {
    keep_fresh();
  } else {
    cuts_[which] = before;
    stadiums_[which] = stadium_before;
  }
  return taken;
}

/// Fresh ones come from their prior but for the anchor: the rest of the density cancels.
bool OutlineChain::switch_cut(int which, Random& random) {
  if (felt_.empty()) return false;
  const auto anchor_ratio = [&](std::size_t anchor) {
    const double share = anchors_[anchor] - (anchor > 0 ? anchors_[anchor - 1] : 0.0);
    return -std::log(static_cast<double>(felt_.size()) * share);
  };
  const OutlineCut& now = cuts_[which];
  if (now.is_present) return try_cut(which, {}, -anchor_ratio(now.anchor), random);
  const auto found = std::ranges::upper_bound(anchors_, random.uniform());
  const auto anchor = std::min<std::size_t>(found - anchors_.begin(), felt_.size() - 1);
  return try_cut(which, drawn_cut(static_cast<int>(anchor), readings_->places[anchor], random),
                 anchor_ratio(anchor), random);
}

bool OutlineChain::move_cut(int which, const OutlineCut& cut, Random& random) {
  const double density = log_cut_density(cut);
  return std::isfinite(density) &&
         try_cut(which, cut, density - log_cut_density(cuts_[which]), random);
}

void OutlineChain::anchor_anew(int which, Random& random) {
  OutlineCut& cut = cuts_[which];
  const double radius = std::exp(cut.log_radius);
  const Vec2 middle = cut.anchor_place + radius * cut.offset;
  std::vector<int> within;
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    if ((readings_->places[i] - middle).squaredNorm() <= radius * radius)
      within.push_back(static_cast<int>(i));
  }
  if (within.empty()) return;
  cut.anchor = within[random.below(static_cast<int>(within.size()))];
  cut.anchor_place = readings_->places[cut.anchor];
  cut.offset = (middle - cut.anchor_place) / radius;
}

}  // namespace palpation
