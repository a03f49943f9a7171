#include "certainty/edge_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "certainty/edge_data.h"

namespace palpation {
namespace {

/// What outlines may be like: most of them smooth all along, one in five with corners.
struct StartPrior {
  KernelFamily family;
  double ShapePrior::*length_m;
  double probability;
};
constexpr std::array kOutlines = {
    StartPrior{KernelFamily::Matern52, &ShapePrior::correction_length_m, 0.8},
    StartPrior{KernelFamily::Matern32, &ShapePrior::corner_length_m, 0.2}};

/// Prior covariance of the corrections at the readings, 0 where none reaches: else a reading that
/// something else raised would be explained by a boundary that is nowhere near.
Eigen::MatrixXd within_reach(const EdgeData& data, const Prior& correction) {
  const Eigen::VectorXd reached =
      (data.depth_m.array().abs() <= kReach * correction.kernel().signal_sd).cast<double>();
  return reached.asDiagonal() * correction.covariance(data.places, data.places) *
         reached.asDiagonal();
}

}  // namespace

std::vector<Start> likely_starts(const Belief& belief, const FirstCuts& cuts, EdgeData all,
                                 const ProfilePrior& profile, const ShapePrior& shape) {
  const Layout layout(belief.prior());
  const Surface& surface = layout.surface();
  // On a plane all metrics are one: the intrinsic one needs no waves there.
  const bool as_believed = surface.is_planar() && belief.prior().metric() != Metric::Intrinsic;
  std::array<std::optional<Start>, kOutlines.size()> best;
  all.part = plateaus_of(surface, cuts.parts, cuts.nearest, all.places);
  for (const double level : cuts.levels) {
    const Field field = levelled(surface, cuts.field, cuts.low, level, cuts.parts, cuts.nearest);
    Eigen::VectorXd distance;
    if (!measure_depths(layout, field, level, distance, all)) continue;
    const EdgeData data = with_plateaus_merged(layout, all);
    for (std::size_t kind = 0; kind < kOutlines.size(); ++kind) {
      const Kernel kernel{.family = kOutlines[kind].family,
                          .length_m = shape.*kOutlines[kind].length_m,
                          .signal_sd = shape.correction_sd_m};
      const Prior correction(surface, as_believed ? belief.prior().metric() : layout.metric(),
                             kernel, Constant{.sd = 0.0});
      Eigen::MatrixXd prior_covariance = within_reach(data, correction);
      EdgeFit edge = fit_edge_belief(data, prior_covariance, profile);
      edge.log_evidence += data.log_scatter;
      if (best[kind] && !(edge.log_evidence > best[kind]->edge.log_evidence)) continue;
      best[kind] = Start{correction, data, std::move(prior_covariance), std::move(edge), distance};
    }
    if (all.reading.size() > kMany) break;  // a second start is not worth their cost
  }
  std::vector<Start> starts;
  for (std::size_t kind = 0; kind < kOutlines.size(); ++kind) {
    if (!best[kind]) continue;
    starts.push_back(std::move(*best[kind]));
    starts.back().weight = starts.back().edge.log_evidence + std::log(kOutlines[kind].probability);
  }
  std::ranges::sort(starts, std::greater{}, &Start::weight);
  double sum = 0.0;
  const double most = starts.empty() ? 0.0 : starts.front().weight;
  for (Start& start : starts) sum += start.weight = std::exp(start.weight - most);
  for (Start& start : starts) start.weight /= sum;
  return starts;
}

}  // namespace palpation
