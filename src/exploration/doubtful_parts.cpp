#include "exploration/doubtful_parts.h"

#include <algorithm>
#include <vector>

#include "certainty/doubts.h"
#include "certainty/own_parts.h"
#include "exploration/search_goal.h"

namespace palpation {
namespace {

/// Of the strongest's contrast: half of what is cut out surely.
constexpr double kLeastDoubtful = 0.5 * kLeastCut;

}  // namespace

void doubt_weaker_parts(Conclusion& conclusion) {
  if (!conclusion.edge || !conclusion.certainty) return;
  const Surface& surface = conclusion.belief.prior().surface();
  if (fading_contact(surface, readings_as_if_unchanged(conclusion))) return;
  const EdgeProfile& profile = conclusion.edge->profile();
  const std::optional<double>& asked = conclusion.model.contrast.least;
  const double least = std::max(kLeastDoubtful * (profile.high - profile.low),
                                asked ? contrast_on_scale(conclusion, *asked) : 0.0);
  std::vector<int> inside;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (conclusion.certainty->score[vertex] >= 0.0) inside.push_back(vertex);
  }
  for (const Misfit& misfit : conclusion.edge->misfits()) {
    if (misfit.kind != MisfitKind::WeakerPart || misfit.amount < least) continue;
    const std::vector<int> part =
        around_summit(surface, conclusion.component.mean, profile.low, *misfit.where, inside);
    // Along a rim, where tissue is held and contact fades, healthy tissue rises, too.
    if (part.empty() || reaches_border(surface, {.vertices = part})) continue;
    double area_m2 = 0.0;
    for (const int vertex : part) area_m2 += surface.vertex_areas()[vertex];
    conclusion.certainty = with_doubtful_part(std::move(*conclusion.certainty), conclusion.belief,
                                              part, ShapePrior{}.correction_sd_m);
    conclusion.evidence.doubtful.push_back({*misfit.where, area_m2});
    inside.insert(inside.end(), part.begin(), part.end());
    std::ranges::sort(inside);
  }
}

}  // namespace palpation
