#include "exploration/as_if_unchanged.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "certainty/edge_data.h"
#include "exploration/background_search.h"
#include "exploration/taken_back.h"
#include "exploration/zero_changes.h"

namespace palpation {
namespace {

/// What level and boundary are of.
Marginals component_of(const Believed& believed, const Model& model, const Marginals& marginals) {
  Marginals component = marginals;
  if (model.field.trend.is_linear)
    component.mean = believed.belief.at_vertices(Part::Detrended).mean;
  return component;
}

/// So often the zeros of sessions are estimated, each time by a field that knows the last ones.
constexpr int kSessionRounds = 3;

/// With what is left of it: true where that is the same change, whose moment the edge knows to a
/// batch.
bool joined(Misfit& change, const Misfit& rest) {
  if (change.kind != rest.kind || change.session != rest.session ||
      std::abs(change.from_batch - rest.from_batch) > 1)
    return false;
  switch (change.kind) {
    case MisfitKind::Moved:
      change.moved_m += rest.moved_m;
      change.amount = change.moved_m.norm();
      return true;
    case MisfitKind::Gain:
      change.amount = (1.0 + change.amount) * (1.0 + rest.amount) - 1.0;
      return true;
    default:
      // All steps of the zero are estimated at once, some of them as two at one moment.
      if (change.session == 0 && change.number != rest.number) return false;
      change.amount += rest.amount;
      change.stddev = rest.stddev;
      return true;
  }
}

/// Behind those that it was found without.
void add_change(const Misfit& change, std::span<const Palpation> palpations,
                std::vector<Misfit>& changes) {
  const Misfit more = as_of_its_session(change, changes, palpations);
  if (std::ranges::none_of(changes, [&](Misfit& earlier) { return joined(earlier, more); }))
    changes.push_back(more);
}

Believed believed_with_one_zero(const Surface& surface, const Model& model,
                                const std::vector<Palpation>& felt, ConclusionCache& cache,
                                ConclusionCache& apart) {
  const bool may_differ = !model.field.trend.is_linear && !model.field.is_noiseless();
  std::vector<Misfit> changes = may_differ ? session_zeros(surface, felt) : std::vector<Misfit>();
  Believed believed =
      changes.empty()
          ? believe(surface, model, felt, cache)
          : believe(surface, model, with_changes_taken_back(surface, felt, changes), apart);
  const auto take_back = [&] {
    believed = believe(surface, model, with_changes_taken_back(surface, felt, changes), apart);
  };
  for (int round = 0; !changes.empty() && round < kSessionRounds; ++round) {
    changes =
        estimated_zeros(as_made(felt, believed.palpations), believed.belief, std::move(changes));
    take_back();
  }
  believed.evidence.taken_back = changes;
  if (!believed.evidence.contrast_seen) return believed;
  const auto again = [&](std::vector<Palpation> changed) {
    return believe(surface, model, std::move(changed), apart).belief;
  };
  const std::vector<Misfit> more = zero_changes(believed.palpations, again, believed.belief);
  if (more.empty()) return believed;
  for (const Misfit& change : more) add_change(change, believed.palpations, changes);
  take_back();
  believed.evidence.taken_back = std::move(changes);
  return believed;
}

Known known_by(const Surface& surface, const Model& model, Believed believed) {
  Marginals marginals = believed.belief.at_vertices();
  Marginals component = component_of(believed, model, marginals);
  BoundaryFit boundary = find_boundary(surface, model, believed, component);
  return {std::move(believed), std::move(marginals), std::move(component), std::move(boundary)};
}

/// So often a gain or a move is taken back, some of them in two steps.
constexpr int kMostTakenBack = 8;

/// That is slower than a tumour of 4 cm2 is wide.
constexpr double kSlowWave_m = 0.0225;

/// Slow waves of healthy tissue have no edge. Shorter ones may be tumours in tissue that waves.
void weigh_against_waves(Known& known) {
  const std::optional<EdgeBelief>& edge = known.boundary.edge;
  const std::optional<double>& of_smooth_field = known.believed.of_smooth_field;
  if (!edge || !of_smooth_field) return;
  const std::vector<Misfit>& changes = known.believed.evidence.taken_back;
  const auto waves = std::ranges::find(changes, MisfitKind::Waves, &Misfit::kind);
  const double of_field = log_evidence_without_edge(known.believed.belief) + *of_smooth_field;
  if (waves == changes.end() && edge->log_evidence() > of_field + surprising()) return;
  const EdgeOdds odds =
      edge->odds_over_waves(waves == changes.end() ? Field() : waves->background.waves);
  known.believed.evidence.of_edge = odds.log_odds;
  if (odds.log_odds < -surprising() && odds.wave_length_m >= kSlowWave_m) known.boundary = {};
}

/// Of readings in the tumour, and of others.
constexpr int kFewestAtEdge = 3;

/// Less of a move is left to the outlines' sampling (outline_model.cpp).
constexpr double kLeastMove_m = 0.0005;
/// Farther than moves are tried (changed_since.cpp), by a step.
constexpr double kFarthestMove_m = 0.008;

bool is_change(const Misfit& misfit) {
  return misfit.kind != MisfitKind::WeakerPart && !is_background(misfit);
}

/// Whether those before it and those since feel an edge: of healthy tissue alone nothing tells
/// where it lies.
bool is_felt_on_both_sides(const Misfit& move, double level, std::span<const Palpation> readings) {
  std::array<std::array<int, 2>, 2> felt{};  // since or before, above the level or below
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Palpation& one = readings[i];
    if (counts(one)) ++felt[is_since(move, {one.batch, i, one.session})][one.reading >= level];
  }
  return std::ranges::all_of(
      felt, [](const auto& side) { return std::ranges::min(side) >= kFewestAtEdge; });
}

/// By an edge, of the readings that count in all these versions of the same.
std::vector<double> log_evidences(const Surface& surface, const Model& model,
                                  std::vector<std::vector<Palpation>> versions) {
  std::vector<double> evidences;
  for (std::vector<Palpation>& version : versions) {
    for (std::size_t i = 0; i < version.size(); ++i) {
      for (const std::vector<Palpation>& other : versions) {
        if (version[i].set_aside.empty()) version[i].set_aside = other[i].set_aside;
      }
    }
  }
  ConclusionCache apart;
  for (std::vector<Palpation>& version : versions) {
    const Known known =
        known_by(surface, model, believe(surface, model, std::move(version), apart));
    evidences.push_back(known.boundary.edge ? known.boundary.edge->log_evidence()
                                            : -std::numeric_limits<double>::infinity());
  }
  return evidences;
}

bool makes_the_outline_likelier(const Misfit& move, const Surface& surface, const Model& model,
                                const std::vector<Palpation>& readings) {
  const std::vector<double> evidences = log_evidences(
      surface, model, {readings, with_changes_taken_back(surface, readings, {&move, 1})});
  return evidences[1] - evidences[0] > surprising();
}

/// What a conclusion does not explain, the strongest first; of each kind once.
std::vector<Misfit> all_misfits(const Model& model, const std::optional<EdgeBelief>& edge,
                                const Belief& belief, std::span<const Palpation> readings) {
  std::vector<Misfit> found;
  if (edge) found = edge->misfits();
  // A move is found by the field, which knows how far, or else by the edge, to first order.
  std::optional<Misfit> move = changed_since(belief);
  if (move && move->kind != MisfitKind::Moved) move.reset();
  const auto by_edge = std::ranges::find(found, MisfitKind::Moved, &Misfit::kind);
  if (by_edge != found.end()) {
    if (!move) move = *by_edge;
    found.erase(by_edge);
  }
  if (edge && move && move->amount >= kLeastMove_m && move->amount <= kFarthestMove_m &&
      is_felt_on_both_sides(*move, edge->level().value, readings) &&
      makes_the_outline_likelier(*move, belief.prior().surface(), model,
                                 {readings.begin(), readings.end()}))
    found.push_back(*move);
  std::ranges::stable_sort(found, std::greater{}, &Misfit::evidence);
  return found;
}

/// The strongest, unless it is of the zero: what of that can be taken back was. A gain passes for a
/// move and a move for a gain: of both the one without which the readings are more probable.
std::optional<Misfit> change_to_take_back(const Model& model, const Known& known,
                                          const std::vector<Palpation>& readings) {
  std::vector<Misfit> found =
      all_misfits(model, known.boundary.edge, known.believed.belief, readings);
  std::erase_if(found, [](const Misfit& misfit) { return !is_change(misfit); });
  if (found.empty() || found.front().kind == MisfitKind::Zero) return std::nullopt;
  std::erase_if(found, [](const Misfit& change) { return change.kind == MisfitKind::Zero; });
  if (found.size() == 1) return found.front();
  const Surface& surface = known.believed.belief.prior().surface();
  std::vector<std::vector<Palpation>> without;
  for (const Misfit& change : found)
    without.push_back(with_changes_taken_back(surface, readings, {&change, 1}));
  const std::vector<double> evidences = log_evidences(surface, model, std::move(without));
  return found[std::ranges::max_element(evidences) - evidences.begin()];
}

}  // namespace

Known known_as_if_unchanged(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache,
                            bool is_last) {
  ConclusionCache apart;
  const KnownOf known_of = [&](const std::vector<Palpation>& palpations) {
    return known_by(surface, model,
                    believed_with_one_zero(surface, model, palpations, apart, apart));
  };
  Known known = without_background(
      surface, model, felt,
      known_by(surface, model, believed_with_one_zero(surface, model, felt, cache, apart)),
      known_of);
  std::vector<Misfit> changes = known.believed.evidence.taken_back;
  std::vector<Palpation> readings = with_changes_taken_back(surface, felt, changes);
  const auto take_back = [&] {
    readings = with_changes_taken_back(surface, felt, changes);
    Believed believed = believe(surface, model, readings, apart);
    believed.evidence.taken_back = changes;
    known = known_by(surface, model, std::move(believed));
  };
  std::map<MisfitKind, double> last;  // its evidence
  for (int round = 0; is_last && known.boundary.edge && round < kMostTakenBack; ++round) {
    const std::optional<Misfit> change = change_to_take_back(model, known, readings);
    if (!change) break;
    // What is no less surprising once it was taken back was not what it was taken for.
    const auto [before, is_first] = last.try_emplace(change->kind, change->evidence);
    if (!is_first && !(change->evidence < before->second)) break;
    before->second = change->evidence;
    add_change(*change, readings, changes);
    take_back();
  }
  if (is_last) weigh_against_waves(known);
  return known;
}

std::vector<Misfit> misfits_of(const Model& model, const std::optional<EdgeBelief>& edge,
                               const Belief& belief, std::span<const Palpation> readings) {
  std::vector<Misfit> found = all_misfits(model, edge, belief, readings);
  if (const auto strongest = std::ranges::find_if(found, is_change); strongest != found.end())
    found.erase(std::remove_if(strongest + 1, found.end(), is_change), found.end());
  return found;
}

}  // namespace palpation
