#include "certainty/outline_chain.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace palpation {
namespace {

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
};

OutlineChain::OutlineChain(const OutlineReadings& readings, const OutlinePrior& prior,
                           OutlineNodes start, OutlineProfile profile)
    : readings_(readings),
      prior_(prior),
      outline_(std::move(start)),
      profile_(std::move(profile)),
      law_(law_of(profile_, prior)),
      felt_(readings.places.size()),
      moves_(outline_.place.size(), false) {
  for (std::size_t i = 0; i < felt_.size(); ++i) {
    const Vec2& place = readings_.places[i];
    felt_[i] = {nearest_piece(outline_, place), is_inside(outline_, place)};
    felt_[i].log_likelihood = likelihood_of(i, felt_[i], law_);
  }
}

double OutlineChain::likelihood_of(std::size_t reading, const Felt& felt,
                                   const ReadingLaw& law) const {
  const double distance = std::sqrt(felt.nearest.square);
  return log_likelihood(law, readings_.reading[reading], readings_.variance[reading],
                        felt.inside ? distance : -distance,
                        outline_.loops[outline_.loop_of[felt.nearest.piece]].part);
}

std::vector<double> OutlineChain::deepest_readings() const {
  std::vector<double> deepest(profile_.log_contrast.size(), 0.0);
  for (const Felt& felt : felt_) {
    double& of_part = deepest[outline_.loops[outline_.loop_of[felt.nearest.piece]].part];
    if (felt.inside) of_part = std::max(of_part, std::sqrt(felt.nearest.square));
  }
  return deepest;
}

double OutlineChain::log_density() const {
  double sum = log_shape_density(outline_, profile_) + log_profile_density(profile_, prior_);
  for (const Felt& felt : felt_) sum += felt.log_likelihood;
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
      if (is_neighbour || (moves_[other] && other < piece.node)) continue;
      if (cross_each_other(outline_.place[piece.node], outline_.place[end], from, to)) return true;
    }
  }
  return false;
}

/// Neither which side it lies on nor what is nearest to it can have changed.
bool OutlineChain::is_untouched(const Step& step, std::size_t reading) const {
  const Vec2& place = readings_.places[reading];
  const NearestPiece& nearest = felt_[reading].nearest;
  return !moves_[nearest.piece] && !step.ever.contains(place) &&
         step.now.squaredExteriorDistance(place) > nearest.square;
}

OutlineChain::Felt OutlineChain::felt_after(const Step& step, std::size_t reading) const {
  const Vec2& place = readings_.places[reading];
  Felt felt = felt_[reading];
  const bool may_flip = step.ever.contains(place);
  NearestPiece moved{.square = 1e300};
  for (const MovedPiece& piece : step.pieces) {
    const Vec2 &from = outline_.place[piece.node], &to = outline_.place[outline_.next(piece.node)];
    if (may_flip)
      felt.inside ^= crosses_ray(place, piece.from, piece.to) != crosses_ray(place, from, to);
    const double square = squared_distance(place, from, to);
    if (square < moved.square) moved = {square, piece.node};
  }
  if (moved.square <= felt.nearest.square) {
    felt.nearest = moved;
  } else if (moves_[felt.nearest.piece]) {
    felt.nearest = nearest_piece(outline_, place);
  }
  felt.log_likelihood = likelihood_of(reading, felt, law_);
  return felt;
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

bool OutlineChain::move_nodes(int first, const std::vector<Vec2>& places, Random& random,
                              double log_volume) {
  Step step = step_from(first, static_cast<int>(places.size()));
  double change = -shape_about(step);
  for (std::size_t i = 0; i < places.size(); ++i) outline_.place[step.nodes[i]] = places[i];
  for (const MovedPiece& piece : step.pieces) {
    moves_[piece.node] = true;
    step.now.extend(outline_.place[piece.node]).extend(outline_.place[outline_.next(piece.node)]);
    step.ever.extend(piece.from).extend(piece.to);
  }
  step.ever.extend(step.now);
  change += shape_about(step) + log_volume;

  std::vector<std::pair<std::size_t, Felt>> fresh;
  bool taken = !crosses_another(step);
  if (taken) {
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      if (is_untouched(step, i)) continue;
      fresh.emplace_back(i, felt_after(step, i));
      change += fresh.back().second.log_likelihood - felt_[i].log_likelihood;
    }
    taken = std::log(random.uniform()) < change;
  }
  for (const MovedPiece& piece : step.pieces) {
    moves_[piece.node] = false;
    if (!taken) outline_.place[piece.node] = piece.from;
  }
  if (!taken) return false;
  for (const auto& [reading, felt] : fresh) felt_[reading] = felt;
  return true;
}

bool OutlineChain::move_profile(const OutlineProfile& profile, bool is_of_shape, Random& random) {
  double change = log_profile_density(profile, prior_) - log_profile_density(profile_, prior_);
  const ReadingLaw law = law_of(profile, prior_);
  std::vector<double> likelihoods;
  if (is_of_shape) {
    change += log_shape_density(outline_, profile) - log_shape_density(outline_, profile_);
  } else {
    for (std::size_t i = 0; i < felt_.size(); ++i) {
      likelihoods.push_back(likelihood_of(i, felt_[i], law));
      change += likelihoods.back() - felt_[i].log_likelihood;
    }
  }
  if (!(std::log(random.uniform()) < change)) return false;
  profile_ = profile;
  law_ = law;
  for (std::size_t i = 0; i < likelihoods.size(); ++i) felt_[i].log_likelihood = likelihoods[i];
  return true;
}

}  // namespace palpation
