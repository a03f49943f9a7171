#include "exploration/weak_parts.h"

#include <algorithm>
#include <cmath>

#include "boundary/superlevel_parts.h"
#include "certainty/doubts.h"
#include "exploration/search_goal.h"

namespace palpation {
namespace {

constexpr double kSurely = 1.645;  // one-sided, 95 %

/// Mean of the component where the contour is below its level.
double healthy_mean(const Conclusion& conclusion) {
  const Field& areas = conclusion.belief.prior().surface().vertex_areas();
  const Contour& contour = *conclusion.contour;
  double sum = 0.0, area = 0.0;
  for (Eigen::Index vertex = 0; vertex < areas.size(); ++vertex) {
    if (contour.field[vertex] >= contour.level) continue;
    sum += areas[vertex] * conclusion.component.mean[vertex];
    area += areas[vertex];
  }
  return area > 0.0 ? sum / area : conclusion.component.mean.minCoeff();
}

struct Judged {
  std::vector<int> vertices;
  WeakerPart part;
  double score = 0.0;  ///< of being strong enough
};

/// The outlines were drawn with it.
void take_off(double part_m2, DrawnNumber& area_m2) {
  for (double* const number : {&area_m2.mean, &area_m2.least, &area_m2.most})
    *number = std::max(*number - part_m2, 0.0);
}

}  // namespace

void take_out_weak_parts(Conclusion& conclusion) {
  const bool has_boundary = conclusion.contour && conclusion.belief.site_count() > 0;
  if (!conclusion.model.contrast.least || !has_boundary) return;
  const Surface& surface = conclusion.belief.prior().surface();
  Contour& contour = *conclusion.contour;
  const double healthy = healthy_mean(conclusion);
  const double least = contrast_on_scale(conclusion, *conclusion.model.contrast.least);
  std::vector<Judged> weak;
  const std::vector<std::vector<int>> parts =
      superlevel_parts(surface, contour.field, contour.level);
  for (const std::vector<int>& part : parts) {
    const int peak = *std::ranges::max_element(
        part, {}, [&](int vertex) { return conclusion.component.mean[vertex]; });
    const double above = conclusion.component.mean[peak] - healthy,
                 sd = std::sqrt(conclusion.component.variance[peak]);
    if (above + kSurely * sd >= least) continue;
    const double contrast =
        as_reading(conclusion.scale(), healthy + above) - as_reading(conclusion.scale(), healthy);
    weak.push_back({part,
                    {surface.at_vertex(peak), contrast},
                    (above - least) / std::max(sd, 1e-12 * std::abs(least))});
  }
  for (const Judged& one : weak) conclusion.evidence.weaker.push_back(one.part);
  if (weak.empty()) return;
  if (weak.size() == parts.size()) {
    conclusion.evidence.contrast_seen = false;
    conclusion.level.reset();
    conclusion.edge.reset();
    conclusion.outlines.reset();
    conclusion.contour.reset();
    conclusion.certainty.reset();
    return;
  }
  for (const Judged& one : weak) {
    double area_m2 = 0.0;
    for (const int vertex : one.vertices) {
      contour.field[vertex] = 2.0 * contour.level - contour.field[vertex];
      area_m2 += surface.vertex_areas()[vertex];
    }
    if (conclusion.outlines) take_off(area_m2, conclusion.outlines->area_m2);
    if (conclusion.certainty)
      conclusion.certainty =
          without_part(std::move(*conclusion.certainty), surface, one.vertices, one.score);
  }
}

}  // namespace palpation
