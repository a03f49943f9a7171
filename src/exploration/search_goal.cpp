#include "exploration/search_goal.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "readings/readings.h"

namespace palpation {
namespace {

std::vector<double> counting_readings(const Conclusion& conclusion) {
  return used_readings(conclusion.belief.detrended_palpations());
}

/// Of the field, over vertices.
double mean_over(const Conclusion& conclusion, const std::vector<int>& vertices) {
  const Field& areas = conclusion.belief.prior().surface().vertex_areas();
  double sum = 0.0, area = 0.0;
  for (const int vertex : vertices) {
    sum += areas[vertex] * conclusion.component.mean[vertex];
    area += areas[vertex];
  }
  return area > 0.0 ? sum / area : 0.0;
}

/// Where few readings stand far apart, the field takes noise for what it follows; outlines do not.
double noise_sd_of(const Conclusion& conclusion) {
  const double drawn = conclusion.outlines ? conclusion.outlines->noise : 1.0;
  return std::max(1.0, drawn) * std::sqrt(conclusion.belief.noise_variance());
}

}  // namespace

double contrast_on_scale(const Conclusion& conclusion, double least) {
  return conclusion.scale() == ReadingScale::Log ? std::log(least) : least;
}

double scatter_of(const Conclusion& conclusion) {
  const double seen = spread_of(counting_readings(conclusion)).sd;
  const bool is_given = !conclusion.model.field.noise.sd.is_learned();
  return seen > 0.0 && is_given ? std::max(seen, std::sqrt(conclusion.belief.noise_variance()))
                                : seen;
}

std::optional<Search> search_after(const Conclusion& conclusion, double probability) {
  if (conclusion.tip_hides_all()) return std::nullopt;
  const std::optional<double>& least = conclusion.model.contrast.least;
  Search search{.sought = {.probability = probability}};
  if (!conclusion.level || conclusion.belief.site_count() == 0) {
    search.centres.resize(
        static_cast<std::size_t>(conclusion.belief.prior().surface().vertex_count()));
    std::iota(search.centres.begin(), search.centres.end(), 0);
    if (conclusion.belief.site_count() == 0) return search;
    const double noise_sd = scatter_of(conclusion);
    if (noise_sd == 0.0) return std::nullopt;
    if (least) search.sought.contrast_to_noise = contrast_on_scale(conclusion, *least) / noise_sd;
    return search;
  }
  const Contour& contour = *conclusion.contour;
  for (Eigen::Index vertex = 0; vertex < contour.field.size(); ++vertex) {
    if (contour.field[vertex] < contour.level) search.centres.push_back(static_cast<int>(vertex));
  }
  if (search.centres.empty()) return std::nullopt;
  const double healthy = mean_over(conclusion, search.centres);
  const double contrast =
      least ? contrast_on_scale(conclusion, *least)
            : (conclusion.level->value - healthy) / conclusion.model.level.fraction;
  search.sought.contrast_to_noise = contrast / noise_sd_of(conclusion);
  if (!(search.sought.contrast_to_noise > 0.0)) return std::nullopt;
  return search;
}

std::optional<double> diameter_ruled_out_m(const Conclusion& conclusion, double probability) {
  const std::optional<Search> search = search_after(conclusion, probability);
  if (!search) return std::nullopt;
  const Layout layout(conclusion.belief.prior());
  const std::optional<double> diameter_m = diameter_ruled_out_m(
      layout, layout.touched(conclusion.belief.palpations()), search->sought, search->centres);
  const bool fits = diameter_m && *diameter_m < layout.surface().diameter();
  return fits ? diameter_m : std::nullopt;
}

Field diameters_undetected_m(const Conclusion& conclusion, double probability) {
  const std::optional<Search> search = search_after(conclusion, probability);
  if (!search) return {};
  const Layout layout(conclusion.belief.prior());
  return diameters_ruled_out_m(layout, layout.touched(conclusion.belief.palpations()),
                               search->sought, search->centres);
}

std::vector<int> stops_to_goal(const Conclusion& conclusion, const Aim& aim,
                               std::span<const int> candidates, std::size_t most) {
  if (!aim.has_goal()) return {};
  const std::optional<Search> search = search_after(conclusion, aim.probability);
  if (!search) return {};
  std::vector<int> centres;
  std::ranges::set_intersection(search->centres, candidates, std::back_inserter(centres));
  const Layout layout(conclusion.belief.prior());
  return touches_to_rule_out(layout, layout.touched(conclusion.belief.palpations()), search->sought,
                             aim.undetected_diameter_m, centres,
                             {.candidates = candidates, .most = most});
}

}  // namespace palpation
