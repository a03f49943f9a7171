#include <cmath>
#include <optional>
#include <utility>

#include "exploration/background_search.h"
#include "exploration/comparable_evidence.h"
#include "exploration/taken_back.h"
#include "exploration/tilt.h"

namespace palpation {
namespace {

/// So often a slope is found again in what the edge without it leaves.
constexpr int kTiltRounds = 3;
constexpr double kFelt = 0.1;  ///< standard deviations of the noise

/// The readings without a slope, and how probable they are: by an edge, or, where none is left, as
/// noise alone.
struct Tilted {
  Misfit tilt;
  Known known;
  double log_evidence = 0.0;
};

class TiltSearch {
 public:
  TiltSearch(const Surface& surface, const std::vector<Palpation>& felt, const KnownOf& known_of,
             double noise_variance)
      : surface_(surface), felt_(felt), known_of_(known_of), noise_variance_(noise_variance) {}

  /// Planes through all readings are the first to ask.
  void ask_planes(std::span<const Palpation> readings) {
    for (const Misfit& tilt : tilts_of_planes(surface_, readings)) {
      if (is_felt(tilt)) sharpen(tried(tilt));
    }
  }

  /// What an edge leaves is the next.
  void ask_edge(const EdgeBelief& edge, std::span<const Palpation> readings) {
    const std::optional<Misfit> tilt = tilt_left(surface_, edge, readings);
    if (tilt && is_felt(*tilt)) sharpen(tried(*tilt));
  }

  std::optional<Tilted>& best() { return best_; }

 private:
  /// Whether it raises readings over the tissue by what could matter beside their noise: of those
  /// that are equal to the last digit rounding makes a slope.
  bool is_felt(const Misfit& tilt) const {
    const Vec3 extent = surface_.mesh().vertices.colwise().maxCoeff() -
                        surface_.mesh().vertices.colwise().minCoeff();
    const double rise = tilt.background.slope_per_m.cwiseAbs().dot(extent);
    return rise > kFelt * std::sqrt(noise_variance_);
  }

  Tilted tried(const Misfit& tilt) const {
    Known known = known_of_(with_changes_taken_back(surface_, felt_, {&tilt, 1}));
    const double log_evidence =
        comparable(log_evidence_or_drop(known), known.believed.belief, noise_variance_);
    return {tilt, std::move(known), log_evidence};
  }

  void sharpen(Tilted tilted) {
    for (int round = 0; round < kTiltRounds && tilted.known.boundary.edge; ++round) {
      std::vector<Misfit> changes = tilted.known.believed.evidence.taken_back;
      changes.insert(changes.begin(), tilted.tilt);
      const std::optional<Misfit> more = tilt_left(
          surface_, *tilted.known.boundary.edge, with_changes_taken_back(surface_, felt_, changes));
      if (!more) break;
      Tilted next = tried(tilt_together(tilted.tilt, *more));
      if (!(next.log_evidence > tilted.log_evidence)) break;
      tilted = std::move(next);
    }
    if (!best_ || tilted.log_evidence > best_->log_evidence) best_ = std::move(tilted);
  }

  const Surface& surface_;
  const std::vector<Palpation>& felt_;
  const KnownOf& known_of_;
  double noise_variance_;  // of readings as they are
  std::optional<Tilted> best_;
};

}  // namespace

std::optional<WithoutBackground> without_tilt(const Surface& surface,
                                              const std::vector<Palpation>& felt, const Known& flat,
                                              const KnownOf& known_of) {
  const std::vector<Palpation> readings =
      with_changes_taken_back(surface, felt, flat.believed.evidence.taken_back);
  const Belief& belief = flat.believed.belief;
  TiltSearch search(surface, felt, known_of, belief.noise_variance());
  search.ask_planes(readings);
  if (flat.boundary.edge) search.ask_edge(*flat.boundary.edge, readings);
  std::optional<Tilted>& tilted = search.best();
  if (!tilted) return std::nullopt;
  const double freedom = std::log(static_cast<double>(belief.site_count())),
               level = comparable(log_evidence_of(flat), belief, belief.noise_variance());
  std::vector<Misfit>& changes = tilted->known.believed.evidence.taken_back;
  changes.insert(changes.begin(), std::move(tilted->tilt));
  return WithoutBackground{std::move(tilted->known), tilted->log_evidence - freedom - level};
}

}  // namespace palpation
