#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "exploration/background_search.h"
#include "exploration/comparable_evidence.h"
#include "exploration/found_again.h"
#include "exploration/soft_spot.h"
#include "exploration/taken_back.h"
#include "exploration/waves.h"

namespace palpation {
namespace {

constexpr int kBackgrounds = 4;  ///< of parallel surfaces: each costs a conclusion

/// The readings without waves, and how probable they are with them.
struct Waved {
  Misfit waves;
  Known known;
  EdgeInWaves edge;
};

/// Of what an edge in level tissue leaves unexplained beyond noise, standard deviations: what waves
/// may leave. Others make up for an edge that lies elsewhere.
constexpr double kMayLeave = 0.5;

/// While one sweeps over tissue, a zero that drifts passes for waves, and waves for it.
bool has_moving_zero(const Known& known) { return steps_of_zero(known) > 0; }

/// What an edge leaves of the readings that count, beyond noise: standard deviation.
double left_by(const Known& known) {
  const Surface& surface = known.believed.belief.prior().surface();
  const EdgeBelief& edge = *known.boundary.edge;
  const EdgeProfile& profile = edge.profile();
  double square = 0.0;
  int count = 0;
  for (const Palpation& one : known.believed.palpations) {
    if (!counts(one)) continue;
    const double share = share_at_depth(profile, surface.interpolate(edge.depth(), one.where)),
                 left = one.reading - profile.low - share * (profile.high - profile.low);
    square += left * left;
    ++count;
  }
  return std::sqrt(std::max(square / count - known.believed.belief.noise_variance(), 0.0));
}

class WavesSearch {
 public:
  WavesSearch(const Surface& surface, const std::vector<Palpation>& felt, const Known& flat,
              const KnownOf& known_of)
      : surface_(surface),
        felt_(felt),
        flat_(flat),
        known_of_(known_of),
        set_aside_(set_aside(flat)) {}

  void ask(Field waves) {
    std::optional<Waved> waved = found_again(
        tried(std::move(waves)), [&](const Waved& found) { return tried(found.edge.waves); });
    if (waved && flat_.boundary.edge && left_by(waved->known) > kMayLeave * left_by(flat_)) return;
    keep_likelier(std::move(waved), best_);
  }

  std::optional<Waved>& best() { return best_; }

 private:
  /// Nothing where no edge is seen or waves alone explain as much, where a zero moves beside the
  /// waves, nor where readings stand out that do not with the waves.
  std::optional<Waved> tried(Field field) const {
    Misfit waves{.kind = MisfitKind::Waves};
    waves.background.waves = field.array() - field.mean();
    Known known = known_of_(with_changes_taken_back(surface_, felt_, {&waves, 1}));
    log_evidence_or_drop(known);
    if (!known.boundary.edge || has_moving_zero(known) || is_all_but_a_patch(known) ||
        set_aside(known) > set_aside_)
      return std::nullopt;
    EdgeInWaves edge = known.boundary.edge->in_slow_waves(waves.background.waves);
    if (!(edge.log_evidence > edge.log_evidence_without_edge + surprising())) return std::nullopt;
    waves.background.wave_scale = edge.scale;
    return Waved{std::move(waves), std::move(known), std::move(edge)};
  }

  const Surface& surface_;
  const std::vector<Palpation>& felt_;
  const Known& flat_;
  const KnownOf& known_of_;
  std::ptrdiff_t set_aside_;
  std::optional<Waved> best_;
};

}  // namespace

double log_evidence_in_waves(const Surface& surface, const Known& known, double noise_variance) {
  double log_evidence = log_evidence_of(known);
  if (known.boundary.edge) {
    Field slope = Field::Zero(surface.vertex_count());
    for (const Misfit& change : known.believed.evidence.taken_back) {
      if (change.kind != MisfitKind::Tilted) continue;
      for (int vertex = 0; vertex < surface.vertex_count(); ++vertex)
        slope[vertex] += added_at(surface, change.background, surface.at_vertex(vertex));
    }
    const EdgeInWaves edge = known.boundary.edge->in_slow_waves(slope);
    log_evidence = std::max(edge.log_evidence, edge.log_evidence_level);
  }
  return comparable(log_evidence, known.believed.belief, noise_variance);
}

std::optional<BesideEdge> without_waves(const Surface& surface, const std::vector<Palpation>& felt,
                                        const Known& flat, const KnownOf& known_of) {
  if (has_moving_zero(flat)) return std::nullopt;
  const Belief& belief = flat.believed.belief;
  const std::vector<Field> backgrounds = waves_of_parallel_surfaces(
      Layout(belief.prior()), gathered_for_edge(belief), surprising(), kBackgrounds);
  if (backgrounds.empty()) return std::nullopt;
  WavesSearch search(surface, felt, flat, known_of);
  if (flat.boundary.edge) search.ask(flat.boundary.edge->in_slow_waves().waves);
  for (const Field& waves : backgrounds) search.ask(waves);
  std::optional<Waved>& waved = search.best();
  if (!waved) return std::nullopt;
  std::vector<Misfit>& changes = waved->known.believed.evidence.taken_back;
  changes.insert(changes.begin(), std::move(waved->waves));
  const double log_evidence =
      comparable(waved->edge.log_evidence, waved->known.believed.belief, belief.noise_variance());
  return BesideEdge{std::move(waved->known), log_evidence};
}

}  // namespace palpation
