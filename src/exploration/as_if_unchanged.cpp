#include "exploration/as_if_unchanged.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

#include "exploration/taken_back.h"
#include "exploration/tilt.h"
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
      if (change.session == 0) return false;  // all steps of the zero are estimated at once
      change.amount += rest.amount;
      change.stddev = rest.stddev;
      return true;
  }
}

void add_change(const Misfit& change, std::span<const Palpation> palpations,
                std::vector<Misfit>& changes) {
  const Misfit more = as_of_its_session(change, changes, palpations);
  if (std::ranges::any_of(changes, [&](Misfit& earlier) { return joined(earlier, more); })) return;
  const auto is_later = [&](const Misfit& other) {
    return other.session == 0 &&
           std::pair(other.from_batch, other.number) > std::pair(more.from_batch, more.number);
  };
  changes.insert(std::ranges::find_if(changes, is_later), more);
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

/// Of readings in the tumour, and of others.
constexpr int kFewestAtEdge = 3;

/// Less of a move is left to the outlines' sampling (outline_model.cpp).
constexpr double kLeastMove_m = 0.0005;

bool is_change(const Misfit& misfit) {
  return misfit.kind != MisfitKind::WeakerPart && misfit.kind != MisfitKind::Tilted;
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

/// Of the readings that count with it and without.
bool makes_the_outline_likelier(const Misfit& move, const Surface& surface, const Model& model,
                                std::vector<Palpation> readings) {
  ConclusionCache apart;
  const auto evidence_of = [&](std::vector<Palpation> palpations) {
    const Known known =
        known_by(surface, model, believe(surface, model, std::move(palpations), apart));
    return known.boundary.edge ? known.boundary.edge->log_evidence()
                               : -std::numeric_limits<double>::infinity();
  };
  std::vector<Palpation> moved = with_changes_taken_back(surface, readings, {&move, 1});
  for (std::size_t i = 0; i < moved.size(); ++i) readings[i].set_aside = moved[i].set_aside;
  return evidence_of(std::move(moved)) - evidence_of(std::move(readings)) > surprising();
}

/// The strongest, unless it is of the zero: what of that can be taken back was.
std::optional<Misfit> change_to_take_back(const Model& model, const Known& known,
                                          std::span<const Palpation> readings) {
  const std::vector<Misfit> found =
      misfits_of(model, known.boundary.edge, known.believed.belief, readings);
  const auto change = std::ranges::find_if(found, is_change);
  if (change == found.end() || change->kind == MisfitKind::Zero) return std::nullopt;
  return *change;
}

}  // namespace

namespace {

/// So often a slope is found again in what the edge without it leaves.
constexpr int kTiltRounds = 3;

/// The readings without a slope, and how probable they are: by an edge, or, where none is left, as
/// noise alone.
struct Tilted {
  Misfit tilt;
  Known known;
  double log_evidence = 0.0;
};

class TiltSearch {
 public:
  TiltSearch(const Surface& surface, const Model& model, std::span<const Palpation> felt,
             ConclusionCache& apart)
      : surface_(surface), model_(model), felt_(felt.begin(), felt.end()), apart_(apart) {}

  /// A field with a slope of its own is the first to ask.
  void ask_field(const std::vector<Palpation>& readings) {
    Model sloped = model_;
    sloped.field.trend.is_linear = true;
    const Believed believed = believe(surface_, sloped, readings, apart_);
    if (!believed.belief.prior().has_slope()) return;
    sharpen(tried(tilt_of(believed.belief), log_evidence_of_plane(believed.belief)));
  }

  /// What an edge leaves is the next.
  void ask_edge(const EdgeBelief& edge, std::span<const Palpation> readings) {
    if (const std::optional<Misfit> tilt = tilt_left(surface_, edge, readings))
      sharpen(tried(*tilt, -std::numeric_limits<double>::infinity()));
  }

  std::optional<Tilted>& best() { return best_; }

 private:
  Tilted tried(const Misfit& tilt, double log_evidence_without_edge) {
    Known known =
        known_by(surface_, model_,
                 believed_with_one_zero(surface_, model_,
                                        with_changes_taken_back(surface_, felt_, {&tilt, 1}),
                                        apart_, apart_));
    const double log_evidence =
        known.boundary.edge ? known.boundary.edge->log_evidence() : log_evidence_without_edge;
    return {tilt, std::move(known), log_evidence};
  }

  void sharpen(Tilted tilted) {
    for (int round = 0; round < kTiltRounds && tilted.known.boundary.edge; ++round) {
      std::vector<Misfit> changes = tilted.known.believed.evidence.taken_back;
      changes.insert(changes.begin(), tilted.tilt);
      const std::optional<Misfit> more = tilt_left(
          surface_, *tilted.known.boundary.edge, with_changes_taken_back(surface_, felt_, changes));
      if (!more) break;
      Tilted next = tried(tilt_together(tilted.tilt, *more), tilted.log_evidence);
      if (!(next.log_evidence > tilted.log_evidence)) break;
      tilted = std::move(next);
    }
    if (!best_ || tilted.log_evidence > best_->log_evidence) best_ = std::move(tilted);
  }

  const Surface& surface_;
  const Model& model_;
  std::vector<Palpation> felt_;
  ConclusionCache& apart_;
  std::optional<Tilted> best_;
};

/// A slope is taken back where that makes the readings more probable than an edge alone does, by
/// more than chance and the freedom to choose it (Schwarz's, of two numbers).
Known known_without_tilt(const Surface& surface, const Model& model,
                         const std::vector<Palpation>& felt, ConclusionCache& cache,
                         ConclusionCache& apart) {
  Known flat = known_by(surface, model, believed_with_one_zero(surface, model, felt, cache, apart));
  if (model.field.trend.is_linear || model.field.is_noiseless() || !flat.boundary.edge) return flat;
  const std::vector<Palpation> readings =
      with_changes_taken_back(surface, felt, flat.believed.evidence.taken_back);
  TiltSearch search(surface, model, felt, apart);
  if (may_be_tilted(surface, readings)) search.ask_field(readings);
  search.ask_edge(*flat.boundary.edge, readings);
  const double needed =
      surprising() + std::log(static_cast<double>(flat.believed.belief.site_count()));
  std::optional<Tilted>& tilted = search.best();
  if (!tilted || !(tilted->log_evidence - flat.boundary.edge->log_evidence() > needed)) return flat;
  std::vector<Misfit>& changes = tilted->known.believed.evidence.taken_back;
  changes.insert(changes.begin(), tilted->tilt);
  return std::move(tilted->known);
}

}  // namespace

Known known_as_if_unchanged(const Surface& surface, const Model& model,
                            const std::vector<Palpation>& felt, ConclusionCache& cache,
                            bool is_last) {
  ConclusionCache apart;
  Known known = known_without_tilt(surface, model, felt, cache, apart);
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
  return known;
}

std::vector<Misfit> misfits_of(const Model& model, const std::optional<EdgeBelief>& edge,
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
  if (edge && move && move->amount >= kLeastMove_m &&
      is_felt_on_both_sides(*move, edge->level().value, readings) &&
      makes_the_outline_likelier(*move, belief.prior().surface(), model,
                                 {readings.begin(), readings.end()}))
    found.push_back(*move);
  std::ranges::stable_sort(found, std::greater{}, &Misfit::evidence);
  if (const auto strongest = std::ranges::find_if(found, is_change); strongest != found.end())
    found.erase(std::remove_if(strongest + 1, found.end(), is_change), found.end());
  return found;
}

}  // namespace palpation
