#include "exploration/as_if_unchanged.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "certainty/contrast.h"
#include "certainty/edge_data.h"
#include "exploration/background_search.h"
#include "exploration/change_search.h"
#include "exploration/session_units.h"
#include "exploration/taken_back.h"
#include "exploration/zero_changes.h"
#include "readings/readings.h"

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

/// Behind those that it was found without, or to one of them; returns which it is.
std::size_t add_change(const Misfit& change, std::span<const Palpation> palpations,
                       std::vector<Misfit>& changes) {
  const Misfit more = as_of_its_session(change, changes, palpations);
  const auto same =
      std::ranges::find_if(changes, [&](Misfit& earlier) { return joined(earlier, more); });
  const auto which = static_cast<std::size_t>(same - changes.begin());
  if (same == changes.end()) changes.push_back(more);
  return which;
}

/// Sessions are brought to one unit first: their gains beyond that are drawn with the outlines.
Believed believed_with_one_zero(const Surface& surface, const Model& model,
                                const std::vector<Palpation>& made, ConclusionCache& cache,
                                ConclusionCache& apart) {
  const bool may_differ = !model.field.trend.is_linear && !model.field.is_noiseless();
  const std::vector<Misfit> units =
      may_differ ? session_units(surface, made) : std::vector<Misfit>();
  const std::vector<Palpation> felt = with_changes_taken_back(surface, made, units);
  std::vector<Misfit> changes = may_differ ? session_zeros(surface, felt) : std::vector<Misfit>();
  Believed believed =
      changes.empty()
          ? believe(surface, model, felt, cache)
          : believe(surface, model, with_changes_taken_back(surface, felt, changes), apart);
  const auto take_back = [&] {
    believed = believe(surface, model, with_changes_taken_back(surface, felt, changes), apart);
  };
  const auto all_changes = [&] {
    std::vector<Misfit> all = units;
    all.insert(all.end(), changes.begin(), changes.end());
    return all;
  };
  for (int round = 0; !changes.empty() && round < kSessionRounds; ++round) {
    changes =
        estimated_zeros(as_made(felt, believed.palpations), believed.belief, std::move(changes));
    take_back();
  }
  believed.evidence.taken_back = all_changes();
  if (!believed.evidence.contrast_seen) return believed;
  const auto again = [&](std::vector<Palpation> changed) {
    return believe(surface, model, std::move(changed), apart).belief;
  };
  const std::vector<Misfit> more = zero_changes(believed.palpations, again, believed.belief);
  if (more.empty()) return believed;
  for (const Misfit& change : more) add_change(change, believed.palpations, changes);
  take_back();
  believed.evidence.taken_back = all_changes();
  return believed;
}

/// So often a gain or a move is taken back, some of them in two steps.
constexpr int kMostTakenBack = 8;

/// Whether it is the sensor's, since a reading that is known to some: those between look like
/// another outline.
bool has_own_moment(const Misfit& change) {
  return change.session == 0 &&
         (change.kind == MisfitKind::Zero || change.kind == MisfitKind::Gain);
}

/// That is slower than a tumour of 4 cm2 is wide.
constexpr double kSlowWave_m = 0.0225;

/// Errors that last are normal: readings that were made so far apart that they err each for itself
/// lie on one plateau then, whatever those between do.
bool may_be_errors(const Known& known, const LastingErrors& errors) {
  const Belief& belief = known.believed.belief;
  const std::vector<Palpation>& one_by_one = known.believed.one_by_one;
  const std::vector<double> readings =
      used_readings(belief.detrended(one_by_one.empty() ? belief.palpations() : one_by_one));
  const auto apart = static_cast<std::size_t>(2.0 * errors.readings);
  return evidence_of_two_plateaus_in_turn(readings, apart) < surprising();
}

/// Errors that last over many readings look like stripes along the way, across which nothing goes
/// on.
void weigh_against_errors_in_turn(Known& known, Eigen::Index readings) {
  if (!known.boundary.edge) return;
  Evidence& evidence = known.believed.evidence;
  const auto drift = std::ranges::find(evidence.taken_back, MisfitKind::Drift, &Misfit::kind);
  const EdgeInErrors edge = known.boundary.edge->in_lasting_errors(
      drift == evidence.taken_back.end() ? Eigen::VectorXd::Zero(readings)
                                         : drift->background.drift);
  evidence.errors_beside_edge = edge.errors;
  const double log_odds = edge.log_evidence - edge.log_evidence_without_edge;
  if (log_odds > surprising()) return;
  evidence.of_edge = {
      .log_odds = log_odds,
      .errors = edge.do_last_without_edge ? edge.errors_without_edge : LastingErrors{}};
  if (log_odds < -surprising() && may_be_errors(known, edge.errors_without_edge))
    known.boundary = {};
}

/// Slow waves of healthy tissue have no edge. Shorter waves may be tumours in tissue that waves.
/// Where readings on the way are many, a few of them taught the field, and what they say of it is
/// not what all say.
void weigh_against_waves(Known& known) {
  const std::optional<EdgeBelief>& edge = known.boundary.edge;
  const std::optional<double>& of_smooth_field = known.believed.of_smooth_field;
  if (!edge || !of_smooth_field) return;
  const std::vector<Misfit>& changes = known.believed.evidence.taken_back;
  const auto waves = std::ranges::find(changes, MisfitKind::Waves, &Misfit::kind);
  const double of_field = log_evidence_without_edge(known.believed.belief) + *of_smooth_field;
  if (waves == changes.end() && known.believed.one_by_one.empty() &&
      edge->log_evidence() > of_field + surprising())
    return;
  const EdgeOdds odds =
      edge->odds_over_waves(waves == changes.end() ? Field() : waves->background.waves);
  std::optional<EdgeOdds>& least = known.believed.evidence.of_edge;
  if (!least || odds.log_odds < least->log_odds) least = odds;
  if (odds.log_odds < -surprising() && odds.wave_length_m >= kSlowWave_m) known.boundary = {};
}

/// As long as readings come, to touch again is cheap: level tissue is the only rival. Noise that
/// was touched where it read high passes for contrast more often than noise anywhere.
void weigh_against_level(Known& known) {
  if (!known.boundary.edge) return;
  const double log_odds =
      known.boundary.edge->log_evidence() - log_evidence_without_edge(known.believed.belief);
  if (log_odds > surprising()) return;
  known.believed.evidence.of_edge = {.log_odds = log_odds};
  if (log_odds < -surprising()) known.boundary = {};
}

}  // namespace

Known known_by(const Surface& surface, const Model& model, Believed believed) {
  Marginals marginals = believed.belief.at_vertices();
  Marginals component = component_of(believed, model, marginals);
  BoundaryFit boundary = find_boundary(surface, model, believed, component);
  return {std::move(believed), std::move(marginals), std::move(component), std::move(boundary)};
}

Known known_as_if_unchanged(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache,
                            bool is_last) {
  ConclusionCache apart;
  const KnownOf known_of = [&](const std::vector<Palpation>& palpations) {
    return known_by(surface, model,
                    believed_with_one_zero(surface, model, palpations, apart, apart));
  };
  std::shared_ptr<const TriedBackgrounds> tried = cache.tried(surface, model, felt);
  if (!tried) {
    Known flat =
        known_by(surface, model, believed_with_one_zero(surface, model, felt, cache, apart));
    tried = std::make_shared<const TriedBackgrounds>(
        tried_backgrounds(surface, model, felt, std::move(flat), known_of));
    cache.remember(tried);
  }
  Known known = without_background(surface, *tried, known_of, is_last);
  std::vector<Misfit> changes = known.believed.evidence.taken_back;
  std::vector<Palpation> readings = with_changes_taken_back(surface, felt, changes);
  const auto take_back = [&] {
    readings = with_changes_taken_back(surface, felt, changes);
    Believed believed = believe(surface, model, readings, apart);
    believed.evidence.taken_back = changes;
    known = known_by(surface, model, std::move(believed));
  };
  for (int round = 0; is_last && known.boundary.edge && round < kMostTakenBack; ++round) {
    const std::optional<RasterStep> step = raster_step(model, known, readings);
    if (step && !step->is_of_tissue()) known.believed.evidence.zero_or_tissue = step->zero;
    const std::optional<Misfit> change =
        step && step->is_of_the_zero() ? step->zero : change_to_take_back(model, known, readings);
    if (!change) break;
    const std::size_t which = add_change(*change, readings, changes);
    if (is_displacement(*change)) look_closer_at(which, changes, surface, model, felt);
    take_back();
  }
  if (is_last) {
    weigh_against_errors_in_turn(known, std::ssize(felt));
    weigh_against_waves(known);
    Evidence& evidence = known.believed.evidence;
    if (known.boundary.edge && std::ranges::none_of(evidence.taken_back, has_own_moment))
      evidence.another_outline = known.boundary.edge->outline_since(evidence.taken_back);
  } else {
    weigh_against_level(known);
  }
  return known;
}

}  // namespace palpation
