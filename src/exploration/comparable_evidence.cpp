#include "exploration/comparable_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certainty/edge_data.h"

namespace palpation {

double comparable(double log_evidence, const Belief& belief, double noise_variance) {
  // Without noise no readings are taken together but those that agree.
  if (!(noise_variance > 0.0)) return log_evidence;
  return log_evidence + 0.5 * belief.site_count() * (std::log(noise_variance) + 1.0);
}

double comparable_evidence(const std::optional<EdgeBelief>& edge, const Belief& belief,
                           double noise_variance) {
  return edge ? comparable(edge->log_evidence(), belief, noise_variance)
              : std::numeric_limits<double>::lowest();
}

double log_scale_of(const Misfit& change, const Belief& belief) {
  if (change.kind != MisfitKind::Gain) return 0.0;
  double since = 0.0;  // rows, one that began before in part
  for (const std::vector<Made>& made : gathered_for_edge(belief).made) {
    const auto later =
        std::ranges::count_if(made, [&](const Made& one) { return is_since(change, one); });
    since += static_cast<double>(later) / static_cast<double>(made.size());
  }
  return -std::log1p(change.amount) * since;
}

}  // namespace palpation
