#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "certainty/errors_in_turn.h"
#include "exploration/background_search.h"
#include "exploration/comparable_evidence.h"
#include "exploration/drift.h"
#include "exploration/found_again.h"
#include "exploration/taken_back.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// Readings, at least, that errors last over: what fades sooner moves no edge, and texture of the
/// tissue along the way looks like it.
constexpr double kLasting = 10.0;
constexpr std::size_t kDrifts = 3;  ///< of parallel lines: each costs a conclusion

/// What steps of the zero that were taken back added to each reading.
Eigen::VectorXd steps_in_turn(const std::vector<Palpation>& felt, const Known& known) {
  Eigen::VectorXd steps = Eigen::VectorXd::Zero(std::ssize(felt));
  for (const Misfit& change : known.believed.evidence.taken_back) {
    if (!is_step_of_zero(change)) continue;
    for (std::size_t i = 0; i < felt.size(); ++i) {
      if (is_since(change, made_of(felt, i))) steps[static_cast<Eigen::Index>(i)] += change.amount;
    }
  }
  return steps;
}

/// The readings without drift, and how probable they are with it.
struct Drifted {
  Misfit drift;
  Known known;
  EdgeInErrors edge;
};

class DriftSearch {
 public:
  DriftSearch(const Surface& surface, const std::vector<Palpation>& felt, const Known& flat,
              const KnownOf& known_of)
      : surface_(surface), felt_(felt), known_of_(known_of), set_aside_(set_aside(flat)) {}

  void ask(const Eigen::VectorXd& drift) {
    keep_likelier(found_again(tried(drift),
                              [&](const Drifted& drifted) { return tried(drifted.edge.drift); }),
                  best_);
  }

  std::optional<Drifted>& best() { return best_; }

 private:
  /// Nothing where no edge is seen or errors alone explain as much, where the zero steps beside the
  /// drift, nor where readings stand out that do not with it.
  std::optional<Drifted> tried(const Eigen::VectorXd& of_each) const {
    Misfit drift{.kind = MisfitKind::Drift};
    drift.background.drift = of_each.array() - of_each.mean();
    Known known = known_of_(with_changes_taken_back(surface_, felt_, {&drift, 1}));
    log_evidence_or_drop(known);
    if (!known.boundary.edge || steps_of_zero(known) > 0 || set_aside(known) > set_aside_)
      return std::nullopt;
    EdgeInErrors edge = known.boundary.edge->in_lasting_errors(drift.background.drift);
    if (edge.errors.readings < kLasting ||
        !(edge.log_evidence > edge.log_evidence_without_edge + surprising()))
      return std::nullopt;
    drift.background.errors = edge.errors;
    return Drifted{std::move(drift), std::move(known), std::move(edge)};
  }

  const Surface& surface_;
  const std::vector<Palpation>& felt_;
  const KnownOf& known_of_;
  std::ptrdiff_t set_aside_;
  std::optional<Drifted> best_;
};

/// By something else that stands out, or reads less, in one place: nats.
double most_explained_by_a_part(const EdgeBelief& edge) {
  double most = 0.0;
  for (const Misfit& one : edge.misfits()) {
    if (one.kind == MisfitKind::WeakerPart) most = std::max(most, one.evidence);
  }
  return most;
}

}  // namespace

double log_evidence_in_errors(const Known& known, Eigen::Index readings, double noise_variance) {
  const Belief& belief = known.believed.belief;
  double log_evidence = log_evidence_of(known);
  if (known.boundary.edge) {
    const EdgeInErrors edge =
        known.boundary.edge->in_lasting_errors(Eigen::VectorXd::Zero(readings));
    log_evidence = std::max({edge.log_evidence, edge.log_evidence_in_texture,
                             log_evidence + most_explained_by_a_part(*known.boundary.edge)});
  }
  return comparable(log_evidence, belief, noise_variance) -
         static_cast<double>(steps_of_zero(known)) *
             std::log(static_cast<double>(belief.site_count()));
}

std::optional<BesideEdge> without_drift(const Surface& surface, const std::vector<Palpation>& felt,
                                        const Known& flat, const KnownOf& known_of) {
  const Eigen::VectorXd steps = steps_in_turn(felt, flat);
  const std::optional<EdgeBelief>& edge = flat.boundary.edge;
  const EdgeInErrors beside = edge ? edge->in_lasting_errors(steps) : EdgeInErrors{};
  if (edge && beside.errors.readings < kLasting) return std::nullopt;
  const Belief& belief = flat.believed.belief;
  EdgeData readings = gathered_for_edge(belief);
  readings.reading += mean_in_turn(steps, readings.made);
  DriftSearch search(surface, felt, flat, known_of);
  if (edge) search.ask(beside.drift);
  for (const Eigen::VectorXd& drift :
       drifts_of_parallel_lines(readings, steps.size(), surprising(), kDrifts))
    search.ask(drift);
  std::optional<Drifted>& drifted = search.best();
  if (!drifted) return std::nullopt;
  std::vector<Misfit>& changes = drifted->known.believed.evidence.taken_back;
  changes.insert(changes.begin(), std::move(drifted->drift));
  const double log_evidence = comparable(drifted->edge.log_evidence, drifted->known.believed.belief,
                                         belief.noise_variance());
  return BesideEdge{std::move(drifted->known), log_evidence};
}

}  // namespace palpation
