#include "exploration/doubtful_parts.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "boundary/superlevel_parts.h"
#include "certainty/doubts.h"
#include "certainty/own_parts.h"
#include "exploration/search_goal.h"

namespace palpation {
namespace {

/// Of the strongest's contrast: half of what is cut out surely.
constexpr double kLeastDoubtful = 0.5 * kLeastCut;
/// A tumour seldom lies along so much of the border; another tissue takes a side of it.
constexpr double kMuchBorder = 0.2;

double border_length(const Surface& surface, const std::function<bool(int)>& counts) {
  double length_m = 0.0;
  for (const std::vector<int>& loop : surface.border_loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int vertex = loop[i], next = loop[(i + 1) % loop.size()];
      if (counts(vertex) && counts(next))
        length_m += (surface.vertex(next) - surface.vertex(vertex)).norm();
    }
  }
  return length_m;
}

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

void doubt_parts_along_border(Conclusion& conclusion) {
  if (!conclusion.certainty) return;
  const Surface& surface = conclusion.belief.prior().surface();
  const Field& score = conclusion.certainty->score;
  const double whole_m = border_length(surface, [](int) { return true; });
  Field without = score, off_border = score;
  for (const std::vector<int>& loop : surface.border_loops()) {
    for (const int vertex : loop) off_border[vertex] = 0.0;
  }
  bool is_any = false;
  for (const std::vector<int>& part : superlevel_parts(surface, score, 0.0)) {
    const double along_m = border_length(
        surface, [&](int vertex) { return std::ranges::binary_search(part, vertex); });
    if (along_m == 0.0 || along_m < kMuchBorder * whole_m) continue;
    const int surest = *std::ranges::max_element(part, {}, [&](int at) { return off_border[at]; });
    double area_m2 = 0.0;
    for (const int vertex : part) {
      without[vertex] = -score[vertex];
      area_m2 += surface.vertex_areas()[vertex];
    }
    is_any = true;
    conclusion.evidence.doubtful.push_back({surface.at_vertex(surest), area_m2, along_m / whole_m});
  }
  if (!is_any) return;
  conclusion.certainty = as_likely_another(*std::move(conclusion.certainty), surface, without);
}

}  // namespace palpation
