#include "exploration/change_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "certainty/edge_data.h"
#include "certainty/outline_model.h"
#include "exploration/comparable_evidence.h"
#include "exploration/felt_since.h"
#include "exploration/lag_fit.h"
#include "exploration/taken_back.h"
#include "exploration/zero_changes.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/lag.h"

namespace palpation {
namespace {

using Readings = std::vector<Palpation>;

/// Less of a move is left to the outlines' sampling (outline_model.cpp).
constexpr double kLeastMove_m = 0.0005;
/// Farther than moves are tried (changed_since.cpp), by a step.
constexpr double kFarthestMove_m = 0.008;
/// Steps of a closer look, in metres and in readings; halved twice.
constexpr double kFirstStep_m = 0.001, kLastStep_m = 0.00025;
constexpr std::ptrdiff_t kReadingsOfStep = 4;
constexpr int kMostSteps = 30;  ///< of each length
/// What stands out by less of what it did is no gain of a sensor that works.
constexpr double kLeastGain = 0.1;

bool is_change(const Misfit& misfit) {
  return misfit.kind != MisfitKind::WeakerPart && !is_background(misfit);
}

/// Of versions of the same readings, those alone that count in all.
void set_aside_alike(std::vector<Readings>& versions) {
  for (Readings& version : versions) {
    for (std::size_t i = 0; i < version.size(); ++i) {
      for (const Readings& other : versions) {
        if (version[i].set_aside.empty()) version[i].set_aside = other[i].set_aside;
      }
    }
  }
}

/// By edges about the boundary that is known, in the field that is, of the readings that count in
/// all these versions of the same.
std::vector<double> log_evidences_around(const Known& known, const Model& model,
                                         std::vector<Readings> versions) {
  set_aside_alike(versions);
  const Belief& belief = known.believed.belief;
  const Belief blank(belief.prior(), belief.options());
  std::vector<double> evidences(versions.size());
  for_ranges(static_cast<int>(versions.size()), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Belief moved = blank.condition_on(versions[i]);
      evidences[i] = comparable_evidence(
          edge_around(model, moved, known.component, {known.boundary.edge->level().value}), moved,
          belief.noise_variance());
    }
  });
  return evidences;
}

/// By how much more probable the readings are by an edge without each of these, of those readings
/// that count with and without them.
std::vector<double> log_gains(std::span<const Misfit> changes, const Belief& belief,
                              const Model& model, std::span<const Palpation> readings) {
  const Surface& surface = belief.prior().surface();
  std::vector<Readings> versions = {{readings.begin(), readings.end()}};
  for (const Misfit& change : changes)
    versions.push_back(with_changes_taken_back(surface, versions.front(), {&change, 1}));
  set_aside_alike(versions);
  ConclusionCache apart;
  std::vector<double> gains;
  double as_they_are = 0.0;
  for (std::size_t i = 0; i < versions.size(); ++i) {
    const Known known =
        known_by(surface, model, believe(surface, model, std::move(versions[i]), apart));
    const double evidence =
        comparable_evidence(known.boundary.edge, known.believed.belief, belief.noise_variance());
    if (i == 0) {
      as_they_are = evidence;
    } else {
      gains.push_back(evidence + log_scale_of(changes[i - 1], known.believed.belief) - as_they_are);
    }
  }
  return gains;
}

/// What a conclusion does not explain, the strongest first; of each kind once, but for a lag, which
/// edge and field may tell differently. A move is found by the field, which knows how far, or else
/// by the edge, to first order.
std::vector<Misfit> all_misfits(const Model& model, const std::optional<EdgeBelief>& edge,
                                const Belief& belief, std::span<const Palpation> readings) {
  if (!edge) return {};
  std::vector<Misfit> found = edge->misfits();
  std::erase_if(found, [&](const Misfit& misfit) {
    return (misfit.kind == MisfitKind::Gain && 1.0 + misfit.amount < kLeastGain) ||
           (misfit.kind == MisfitKind::Late && model.field.probe.has_lag());
  });
  const std::optional<Misfit> lag = lag_seen(model.field, *edge, belief);
  if (lag) found.push_back(*lag);
  std::optional<Misfit> move = changed_since(belief);
  if (move && move->kind != MisfitKind::Moved) move.reset();
  const auto by_edge = std::ranges::find(found, MisfitKind::Moved, &Misfit::kind);
  if (by_edge != found.end()) {
    if (!move) move = *by_edge;
    found.erase(by_edge);
  }
  if (move && move->amount >= kLeastMove_m && move->amount <= kFarthestMove_m &&
      is_felt_on_both_sides(*move, edge->level().value, readings) &&
      is_felt_again(*move, belief.prior().surface(), readings))
    found.push_back(*move);
  std::ranges::stable_sort(found, std::greater{}, &Misfit::evidence);
  return found;
}

/// In the plane that the readings lie in on the whole.
std::pair<Vec3, Vec3> plane_of(const Surface& surface, const Readings& readings) {
  Vec3 normal = Vec3::Zero();
  for (const Palpation& one : readings) normal += surface.normal(one.where);
  const Vec3 across = normal.unitOrthogonal();
  return {across, normal.normalized().cross(across)};
}

Misfit moved_on(Misfit move, const Vec3& by_m) {
  move.moved_m += by_m;
  move.amount = move.moved_m.norm();
  return move;
}

Misfit later_by(Misfit lag, double by_m) {
  lag.amount += by_m;
  return lag;
}

/// The same from another reading on.
Misfit made_later(Misfit move, const Readings& felt, std::ptrdiff_t by) {
  const std::ptrdiff_t number = static_cast<std::ptrdiff_t>(move.number) + by;
  move.number =
      static_cast<std::size_t>(std::clamp(number, std::ptrdiff_t{1}, std::ssize(felt) - 1));
  move.from_batch = felt[move.number].batch;
  return move;
}

bool begins_a_session(std::size_t number, const Readings& felt) {
  return number > 0 && felt[number].session != felt[number - 1].session;
}

/// The same with the session that begins the nearest; itself where none begins.
Misfit made_with_a_session(Misfit move, const Readings& felt) {
  std::optional<std::size_t> nearest;
  const auto off = [&](std::size_t number) {
    return std::abs(static_cast<std::ptrdiff_t>(number) - static_cast<std::ptrdiff_t>(move.number));
  };
  for (std::size_t number = 1; number < felt.size(); ++number) {
    if (begins_a_session(number, felt) && (!nearest || off(number) < off(*nearest)))
      nearest = number;
  }
  if (!nearest) return move;
  move.number = *nearest;
  move.from_batch = felt[*nearest].batch;
  return move;
}

/// It, and what is a step away.
std::vector<Misfit> steps_from(const Misfit& change, double step_m, std::ptrdiff_t later,
                               const std::pair<Vec3, Vec3>& plane, const Readings& felt) {
  if (change.kind == MisfitKind::Late)
    return {change, later_by(change, step_m), later_by(change, -step_m)};
  std::vector<Misfit> steps = {change};
  for (const Vec3& way : {plane.first, plane.second}) {
    steps.push_back(moved_on(change, step_m * way));
    steps.push_back(moved_on(change, -step_m * way));
  }
  steps.push_back(made_later(change, felt, later));
  steps.push_back(made_later(change, felt, -later));
  steps.push_back(made_with_a_session(change, felt));
  return steps;
}

/// Of how far and when, but for a constant: as likely with a session as with any other reading.
double log_prior_of(const Misfit& change, const Readings& felt) {
  const double z = change.amount / (change.kind == MisfitKind::Late ? LagPrior{}.sd_m : kMoveSd_m);
  const bool is_with_session =
      change.kind == MisfitKind::Moved && begins_a_session(change.number, felt);
  return (is_with_session ? std::log(static_cast<double>(felt.size())) : 0.0) - 0.5 * z * z;
}

}  // namespace

std::optional<Misfit> change_to_take_back(const Model& model, const Known& known,
                                          const std::vector<Palpation>& readings) {
  const Belief& belief = known.believed.belief;
  std::vector<Misfit> found = all_misfits(model, known.boundary.edge, belief, readings);
  std::erase_if(found, [](const Misfit& misfit) { return !is_change(misfit); });
  if (found.empty()) return std::nullopt;
  const std::vector<double> gains = log_gains(found, belief, model, readings);
  const auto best = std::ranges::max_element(gains);
  const Misfit& likeliest = found[best - gains.begin()];
  if (likeliest.kind == MisfitKind::Zero || !(*best > surprising())) return std::nullopt;
  return likeliest;
}

std::optional<RasterStep> raster_step(const Model& model, const Known& known,
                                      const std::vector<Palpation>& readings) {
  const Belief& belief = known.believed.belief;
  const Surface& surface = belief.prior().surface();
  const Readings& screened = known.believed.palpations;
  const std::optional<Misfit> found = zero_or_tissue(screened, belief);
  if (!found || !known.boundary.edge) return std::nullopt;
  ConclusionCache apart;
  const auto without = [&](const Misfit& step) {
    return believe(surface, model, with_changes_taken_back(surface, readings, {&step, 1}), apart);
  };
  // Of a large step the field, which knows nothing of it, takes a part.
  RasterStep step{.zero = estimated_zeros(screened, without(*found).belief, {*found}).front()};
  const Known then = known_by(surface, model, without(step.zero));
  const Belief& left = then.believed.belief;
  const double noise_variance = belief.noise_variance();
  const double evidence = then.boundary.edge
                              ? comparable_evidence(then.boundary.edge, left, noise_variance)
                              : comparable(log_evidence_without_edge(left), left, noise_variance);
  step.gain = evidence - comparable_evidence(known.boundary.edge, belief, noise_variance);
  step.leaves_another_edge =
      then.boundary.edge &&
      is_felt_on_both_sides(step.zero, then.boundary.edge->level().value, then.believed.palpations);
  return step;
}

void look_closer_at(std::size_t which, std::vector<Misfit>& changes, const Surface& surface,
                    const Model& model, const std::vector<Palpation>& felt) {
  const std::pair<Vec3, Vec3> plane = plane_of(surface, felt);
  std::ptrdiff_t later = kReadingsOfStep;
  for (double step_m = kFirstStep_m; step_m >= kLastStep_m; step_m *= 0.5, later /= 2) {
    ConclusionCache apart;
    const Known known =
        known_by(surface, model,
                 believe(surface, model, with_changes_taken_back(surface, felt, changes), apart));
    if (!known.boundary.edge) return;
    bool is_better = true;
    for (int step = 0; is_better && step < kMostSteps; ++step) {
      const std::vector<Misfit> tried = steps_from(changes[which], step_m, later, plane, felt);
      std::vector<Readings> versions;
      for (const Misfit& one : tried) {
        changes[which] = one;
        versions.push_back(with_changes_taken_back(surface, felt, changes));
      }
      std::vector<double> evidences = log_evidences_around(known, model, std::move(versions));
      for (std::size_t i = 0; i < tried.size(); ++i) evidences[i] += log_prior_of(tried[i], felt);
      const auto best = std::ranges::max_element(evidences);
      changes[which] = tried[best - evidences.begin()];
      is_better = best != evidences.begin();
    }
  }
}

std::vector<Misfit> misfits_of(const Model& model, const std::optional<EdgeBelief>& edge,
                               const Belief& belief, std::span<const Palpation> readings) {
  std::vector<Misfit> found = all_misfits(model, edge, belief, readings);
  std::erase_if(found, [&](const Misfit& one) {
    return is_displacement(one) &&
           !(log_gains({&one, 1}, belief, model, readings).front() > surprising());
  });
  if (const auto strongest = std::ranges::find_if(found, is_change); strongest != found.end())
    found.erase(std::remove_if(strongest + 1, found.end(), is_change), found.end());
  return found;
}

}  // namespace palpation
