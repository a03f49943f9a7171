#include "certainty/outline_walk.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "palpation/base/interruption.h"

namespace palpation {
namespace {

/// Nodes to either side that move along with a stretch's middle.
constexpr std::array kHalfWidths = {0, 1, 3, 7};
constexpr double kLeast_m = 1e-8;
constexpr double kGain = 0.3;  ///< of a length's logarithm, a step
constexpr double kSpacingStep = 0.05;
constexpr double kNear_m = 0.003, kNothingFelt = 1e-12;
constexpr int kSizes = 4;                ///< a sweep
constexpr double kSlopePerGrowth = 2.0;  ///< of their logarithms, how far they are tried
constexpr int kProfileRounds = 2;
constexpr int kResidualsEvery = 4;  ///< sweeps: it costs as much as they do

double angle_of(Random& random) { return 2.0 * std::numbers::pi * random.uniform(); }

Vec2 middle_of(std::span<const Vec2> places) {
  Vec2 middle = Vec2::Zero();
  for (const Vec2& place : places) middle += place / static_cast<double>(places.size());
  return middle;
}

/// About their middle. Returns the logarithm of how much larger a volume of them becomes, but for
/// the middle, which stays.
double grow(std::span<Vec2> places, double log_growth) {
  const Vec2 middle = middle_of(places);
  for (Vec2& place : places) place = middle + std::exp(log_growth) * (place - middle);
  return 2.0 * (static_cast<double>(places.size()) - 1.0) * log_growth;
}

/// Of what is felt near each node, the part that was after a change.
std::vector<double> share_since(const OutlineReadings& readings, const OutlinePrior& prior,
                                int change, const OutlineNodes& outline) {
  std::vector<double> share;
  for (const Vec2& node : outline.place) {
    double since = 0.0, all = kNothingFelt;
    for (std::size_t i = 0; i < readings.places.size(); ++i) {
      const double near =
          std::exp(-0.5 * (readings.places[i] - node).squaredNorm() / (kNear_m * kNear_m));
      const int epoch = readings.epoch.empty() ? 0 : readings.epoch[i];
      if (std::ranges::count(prior.epochs[epoch], change) > 0) since += near;
      all += near;
    }
    share.push_back(since / all);
  }
  return share;
}

}  // namespace

Vec2 direction_of(Random& random) {
  const double angle = angle_of(random);
  return {std::cos(angle), std::sin(angle)};
}

OutlineWalk::OutlineWalk(const OutlineReadings& readings, const OutlinePrior& prior,
                         OutlineNodes start, OutlineProfile profile, std::uint64_t seed)
    : chain_(readings, prior, std::move(start), std::move(profile)), random_(seed) {
  const OutlineNodes& outline = chain_.outline();
  lengths_.of_stretches.resize(outline.place.size());
  for (auto& lengths : lengths_.of_stretches) lengths.fill(kFirst_m);
  lengths_.of_loops.resize(outline.loops.size());
  for (auto& lengths : lengths_.of_loops) lengths.fill(kFirst_m);
  lengths_.of_contrasts.assign(chain_.profile().log_contrast.size(), 0.1);
  lengths_.of_changes.assign(prior.changes.size(), kFirst_m);
  lengths_.of_moves.assign(prior.changes.size(), kFirst_m);
  for (std::size_t change = 0; change < prior.changes.size(); ++change)
    felt_since_.push_back(share_since(readings, prior, static_cast<int>(change), outline));
  lengths_.of_ways[0].assign(readings.places.size(), 1.0);
  lengths_.of_ways[1].assign(static_cast<std::size_t>(readings.ways.lasting.cols()), 1.0);
  if (readings.ways.lasting.cols() > 0)
    same_way_ = readings.ways.lasting.completeOrthogonalDecomposition().solve(
        Eigen::VectorXd::Ones(readings.ways.lasting.rows()));
  lengths_.of_profile.fill(0.1);
  lengths_.of_cuts = {0.3, 0.2, 0.001, 0.5};
  lengths_.of_core = {kFirst_m, kFirst_m, 0.1, kFirst_m, 0.3, 0.05};
}

void OutlineWalk::settle(int sweeps, int telling) {
  settling_ = true;
  for (int i = 0; i < sweeps; ++i) {
    keeps_telling_ = i < telling;
    sweep();
  }
  settling_ = keeps_telling_ = false;
}

std::vector<OutlineDraw> OutlineWalk::draws(int sweeps, int count) {
  std::vector<OutlineDraw> draws;
  for (int i = 0; i < sweeps; ++i) {
    sweep();
    if (static_cast<int>(draws.size()) * sweeps < (i + 1) * count &&
        static_cast<int>(draws.size()) < count)
      draws.push_back(drawn());
  }
  return draws;
}

OutlineDraw OutlineWalk::drawn() {
  OutlineDraw draw{
      .outline = chain_.outline(),
      .profile = chain_.profile(),
      .law = chain_.law(),
      .has_plateau = random_.uniform() < plateau_probability(chain_.profile(), chain_.prior()),
      .cuts = {},
      .steps = steps_,
      .log_noise = chain_.residuals().log_noise(),
      .noise_growth = chain_.residuals().growth_of_noise(),
      .unheeded = chain_.residuals().unheeded()};
  for (const OutlineCut& cut : chain_.cuts()) {
    if (cut.is_present) draw.cuts.push_back(cut.stadium());
  }
  return draw;
}

void OutlineWalk::tune(double& length, bool taken, double share, double most) const {
  if (settling_)
    length = std::clamp(length * std::exp(kGain * ((taken ? 1.0 : 0.0) - share)), kLeast_m, most);
}

void OutlineWalk::sweep() {
  check_interruption();
  const int count = chain_.outline().count();
  for (int node = 0; node < count; ++node) move_stretch(random_.below(count), 0);
  for (int width = 1; width < kWidths; ++width) {
    for (int i = 0; i < std::max(4, count / 2); ++i) move_stretch(random_.below(count), width);
  }
  if (chain_.profile().turns.kind == LineKind::Polygonal) move_sides();
  for (std::size_t loop = 0; loop < chain_.outline().loops.size(); ++loop) {
    // Two of them: each costs as much as many a stretch.
    for (int i = 0; i < 2; ++i) move_loop(static_cast<int>(loop), random_.below(kWhole));
  }
  for (int i = 0; i < kSizes; ++i) move_size();
  for (int round = 0; round < kProfileRounds; ++round) {
    move_profile();
    move_core();
  }
  move_changes();
  wander();
  if (swept_++ % kResidualsEvery == 0) steps_ = chain_.redraw_residuals(random_, keeps_telling_);
  move_cuts();
}

/// All in one direction, the middle the farthest: as likely there as back.
void OutlineWalk::move_stretch(int middle, int width) {
  const OutlineNodes& outline = chain_.outline();
  const NodeLoop& loop = outline.loops[outline.loop_of[middle]];
  const int half = kHalfWidths[width], count = 2 * half + 1;
  if (count > loop.count - 2) return;
  double& length = lengths_.of_stretches[middle][width];
  const Vec2 way = length * random_.normal() * direction_of(random_);
  const int first = loop.first + (middle - loop.first + loop.count - half) % loop.count;
  std::vector<Vec2> places;
  for (int i = 0, node = first; i < count; ++i, node = outline.next(node)) {
    const double phase = std::numbers::pi * (i - half) / (half + 1.0);
    places.push_back(outline.place[node] + 0.5 * (1.0 + std::cos(phase)) * way);
  }
  tune(length, chain_.move_nodes(first, places, random_), kOfNodes, kMost_m);
}

/// Moved, grown, turned, or bent in one to three waves.
void OutlineWalk::move_loop(int loop, int kind) {
  const OutlineNodes& outline = chain_.outline();
  const auto [first, count, part, turns] = outline.loops[loop];
  const auto begin = outline.place.begin() + first;
  std::vector<Vec2> places(begin, begin + count);
  const Vec2 middle = middle_of(places);
  double& length = lengths_.of_loops[loop][kind];
  const double step = length * random_.normal();
  double log_volume = 0.0;
  if (kind == 0) {
    const Vec2 way = step * direction_of(random_);
    for (Vec2& place : places) place += way;
  } else if (kind == 1) {
    log_volume = grow(places, step / kMost_m);
  } else if (kind == 2) {
    const double turn = step / kMost_m, cosine = std::cos(turn), sine = std::sin(turn);
    for (Vec2& place : places) {
      const Vec2 arm = place - middle;
      place = middle + Vec2(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
    }
  } else {
    const double waves = kind - 2, phase = angle_of(random_);
    const Vec2 way = step * direction_of(random_);
    for (int i = 0; i < count; ++i)
      places[i] += std::cos(2.0 * std::numbers::pi * waves * i / count + phase) * way;
  }
  tune(length, chain_.move_nodes(first, places, random_, log_volume), kOfNodes, kMost_m);
}

/// The inside grows, holes shrink, and edges are steeper or less steep.
void OutlineWalk::move_size() {
  const double log_growth = lengths_.of_size * random_.normal(),
               steeper = kSlopePerGrowth * lengths_.of_size * random_.normal();
  std::vector<Vec2> places = chain_.outline().place;
  double log_volume = 0.0;
  for (const NodeLoop& loop : chain_.outline().loops)
    log_volume += grow(std::span(places).subspan(loop.first, loop.count), loop.turns * log_growth);
  const bool taken = chain_.move_whatever_plateaus(places, chain_.profile().log_slope + steeper,
                                                   random_, log_volume);
  tune(lengths_.of_size, taken, kOfNodes, 1.0);
}

void OutlineWalk::move_profile() {
  chain_.switch_lean(random_);
  switch_line_kind();
  for (int i = 0; i < kOfProfile; ++i) {
    OutlineProfile profile = chain_.profile();
    double* const lean = profile.lean ? profile.lean->data() : nullptr;
    using Number = std::pair<double*, bool>;  // whether it is of turns
    const std::array<Number, kOfProfile> numbers = {{{&profile.log_slope, false},
                                                     {lean, false},
                                                     {lean ? lean + 1 : lean, false},
                                                     {lean ? lean + 2 : lean, false},
                                                     {lean ? lean + 3 : lean, false},
                                                     {&profile.log_powers.x(), false},
                                                     {&profile.log_powers.y(), false},
                                                     {&profile.turns.log_half_width, true},
                                                     {&profile.turns.log_bend, true}}};
    const auto [value, is_of_turns] = numbers[i];
    if (value == nullptr) continue;
    *value += lengths_.of_profile[i] * random_.normal();
    tune(lengths_.of_profile[i], chain_.move_profile(profile, is_of_turns, random_), kOfNumbers,
         1e300);
  }
  for (std::size_t part = 1; part < lengths_.of_contrasts.size(); ++part) {
    OutlineProfile profile = chain_.profile();
    profile.log_contrast[part] += lengths_.of_contrasts[part] * random_.normal();
    tune(lengths_.of_contrasts[part], chain_.move_profile(profile, false, random_), kOfNumbers,
         1.0);
  }
  for (std::size_t loop = 0; loop < chain_.profile().log_spacing.size(); ++loop) {
    OutlineProfile profile = chain_.profile();
    profile.log_spacing[loop] += kSpacingStep * random_.normal();
    chain_.move_profile(profile, true, random_);
  }
}

void OutlineWalk::switch_line_kind() {
  if (keeps_telling_) return;
  OutlineProfile profile = chain_.profile();
  profile.turns.kind = draw_line_kind(random_);
  chain_.move_profile(profile, true, random_);
}

}  // namespace palpation
