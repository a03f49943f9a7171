#include "exploration/batch_choice.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "boundary/superlevel_parts.h"
#include "exploration/field_fit.h"
#include "exploration/search_goal.h"
#include "exploration/softer_reach.h"
#include "palpation/geometry/distance.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// While no contrast is seen: the part of a batch that looks again where readings were high, and
/// how noisy they are taken to be then, as a part of their standard deviation. Half of the variance
/// noise is what tells a tumour's few readings from a fluke least hastily.
constexpr double kSecondLooks = 0.3;
constexpr double kDoubt = 0.7;

/// How far from what the outline does not explain its summit is looked for: the radius of a nodule
/// that its skirt alone gives away.
constexpr double kSummit_m = 0.006;
/// What the field may yet reach: standard deviations.
constexpr double kMayReach = 2.0;

/// Part of the touches at the edge that go to that of softer tissue, at most.
constexpr double kMostSofter = 0.5;

/// A batch in the making.
struct Batching {
  const Conclusion& conclusion;
  const Plan& plan;
  std::span<const int> candidates;
  BatchOptions options;
  int left;  ///< batches of the plan, this one included

  const Surface& surface() const { return conclusion.belief.prior().surface(); }
  const FieldModel& field() const { return conclusion.model.field; }
};

/// What will be felt at these stops, and on the way to them, if all is as it is believed to be.
std::vector<Palpation> suppositions(const Batching& batch, const Belief& belief,
                                    std::span<const int> stops) {
  const Surface& surface = batch.surface();
  const Field& mean = batch.conclusion.marginals.mean;
  std::vector<Palpation> supposed;
  std::vector<Vec3> places;
  if (batch.options.from) places.push_back(surface.position(*batch.options.from));
  for (const int stop : stops) {
    for (const Supposed& reading :
         supposed_on_the_way(belief, places, stop, batch.options.way_reading_m)) {
      supposed.push_back({.where = surface.at_vertex(reading.vertex),
                          .reading = mean[reading.vertex],
                          .noise_variance = reading.noise_variance});
    }
    supposed.push_back({.where = surface.at_vertex(stop), .reading = mean[stop]});
    places.push_back(surface.vertex(stop));
  }
  return supposed;
}

/// The candidates that keep their distance from the stops.
std::vector<int> apart_from(const Batching& batch, std::span<const int> stops) {
  std::vector<int> others(batch.candidates.begin(), batch.candidates.end());
  std::vector<int> taken(stops.begin(), stops.end());
  for (const int stop : stops) {
    const std::vector<int> near =
        vertices_near(batch.surface(), stop, batch.options.least_spacing_m);
    taken.insert(taken.end(), near.begin(), near.end());
  }
  std::sort(taken.begin(), taken.end());
  std::erase_if(others,
                [&](int vertex) { return std::binary_search(taken.begin(), taken.end(), vertex); });
  return others;
}

/// These stops, and as many others as the batch still takes by the acquisition (equation 3), of a
/// belief that supposes the stops touched.
std::vector<int> with_others(const Batching& batch, std::vector<int> stops, Belief believed) {
  BatchOptions options = batch.options;
  if (!stops.empty()) {
    believed = believed.condition_on(suppositions(batch, believed, stops));
    options.size -= static_cast<int>(stops.size());
  }
  const std::vector<int> rest =
      choose_batch(believed, acquisition_in_force(batch.conclusion, batch.plan),
                   batch.conclusion.level.value_or(Level{}), apart_from(batch, stops), options)
          .vertices;
  stops.insert(stops.end(), rest.begin(), rest.end());
  return stops;
}

/// Of a disk as large as the largest part that was found; 0 where none was.
double found_diameter_m(const Conclusion& conclusion) {
  if (!conclusion.edge || !conclusion.contour) return 0.0;
  const Surface& surface = conclusion.belief.prior().surface();
  double most_m2 = 0.0;
  for (const std::vector<int>& part :
       superlevel_parts(surface, conclusion.contour->field, conclusion.contour->level)) {
    double area_m2 = 0.0;
    for (const int vertex : part) area_m2 += surface.vertex_areas()[vertex];
    most_m2 = std::max(most_m2, area_m2);
  }
  return std::sqrt(4.0 * most_m2 / std::numbers::pi);
}

/// Where a tumour of the goal's size could still hide, or without a goal another one like that
/// which was found: as many stops as that takes, or the plan has left.
std::vector<int> lacking_stops(const Batching& batch) {
  Aim aim = batch.plan.aim;
  if (!aim.has_goal()) aim.undetected_diameter_m = found_diameter_m(batch.conclusion);
  return stops_to_goal(
      batch.conclusion, aim, batch.candidates,
      static_cast<std::size_t>(batch.left) * static_cast<std::size_t>(batch.options.size));
}

/// How many of these this batch must take, so that those to come take no more: none without a goal,
/// for which the edge gives up nothing.
int due(const Batching& batch, const std::vector<int>& lacking) {
  if (!batch.plan.aim.has_goal()) return 0;
  const int lack = static_cast<int>(lacking.size());
  return std::min((lack + batch.left - 1) / batch.left, batch.options.size);
}

/// Adds what of `more` keeps its distance, as far as the batch has room.
void add_apart(const Batching& batch, std::span<const int> more, std::vector<int>& stops) {
  for (const int stop : more) {
    if (static_cast<int>(stops.size()) >= batch.options.size) return;
    const std::vector<int> free = apart_from(batch, stops);
    if (std::ranges::binary_search(free, stop)) stops.push_back(stop);
  }
}

/// Near something that stands out beside the boundary, what may yet be highest.
void add_summit(const Batching& batch, const Misfit& standing_out, std::vector<int>& stops) {
  const Marginals& marginals = batch.conclusion.marginals;
  const auto may_reach = [&](int vertex) {
    return marginals.mean[vertex] + kMayReach * std::sqrt(marginals.variance[vertex]);
  };
  const Surface& surface = batch.surface();
  const int centre = surface.nearest_vertex(surface.position(*standing_out.where));
  const std::vector<int> near = vertices_near(surface, centre, kSummit_m);
  std::vector<int> outside;
  std::ranges::set_intersection(batch.candidates, near, std::back_inserter(outside));
  std::erase_if(outside, [&](int vertex) { return batch.conclusion.edge->depth()[vertex] >= 0.0; });
  if (outside.empty()) return;
  add_apart(batch, std::vector{*std::ranges::max_element(outside, {}, may_reach)}, stops);
}

/// Where readings stand out that the boundary does not explain: so many stops at most.
void add_unexplained(const Batching& batch, std::size_t most, std::vector<int>& stops) {
  for (const Misfit& misfit : batch.conclusion.edge->misfits()) {
    if (stops.size() >= most) return;
    if (misfit.kind == MisfitKind::WeakerPart && misfit.amount > 0.0)
      add_summit(batch, misfit, stops);
  }
}

/// Surprising or not: a second look at what stands out the most, of the touches that search.
void add_second_look(const Batching& batch, std::vector<int>& stops) {
  if (const std::optional<Misfit> most = batch.conclusion.edge->stands_out_most())
    add_summit(batch, *most, stops);
}

/// Where touches tell the most of how far softer tissue reaches: at most half of those that go to
/// the edge, by what it may leave out beside what the edge may be wrong by.
void add_softer_reach(const Batching& batch, int count, std::vector<int>& stops) {
  const std::optional<SofterReach> softer = softer_reach(batch.conclusion);
  if (!softer || !(softer->unexplained_m2 > 0.0)) return;
  const double unexplained_m2 = softer->unexplained_m2,
               share =
                   unexplained_m2 / (unexplained_m2 + batch.conclusion.edge->expected_error_m2());
  const auto most = static_cast<int>(std::lround(std::min(share, kMostSofter) * count));
  add_apart(batch,
            softer->edge.most_telling(batch.candidates, most, batch.options.least_spacing_m,
                                      batch.conclusion.marginals.variance),
            stops);
}

/// No contrast is seen yet: spread over the tissue, and a second look where readings were high.
/// What is lacking to a goal goes before what is spread.
std::vector<int> searching_stops(const Batching& batch, std::span<const int> lacking) {
  const FieldModel& field = batch.field();
  const std::vector<Palpation>& known = batch.conclusion.belief.palpations();
  const std::vector<double> readings = used_readings(known);
  const Belief blank = unlearned(batch.surface(), field);
  std::vector<int> stops;
  if (batch.conclusion.model.contrast.safe_start && field.learns() && readings.size() > 1 &&
      !all_equal(readings)) {
    Kernel kernel = kernel_of(field.kernel);
    kernel.signal_sd = spread_of(readings).sd;
    const Belief doubting(blank.prior().with(kernel), {.noise_sd = kDoubt * kernel.signal_sd});
    BatchOptions options = batch.options;
    options.size = static_cast<int>(std::floor(kSecondLooks * options.size));
    stops = choose_batch(doubting.condition_on(known), ucb(0.5), Level{}, batch.candidates, options)
                .vertices;
  }
  add_apart(batch, lacking, stops);
  return with_others(batch, std::move(stops), blank.condition_on(known));
}

/// The field of one large tumour is smooth; a second, small one would hide between touches that are
/// spread by its length. Look for it with the length that was likely beforehand, where that is
/// shorter.
Belief searching_belief(const Conclusion& conclusion) {
  const Belief& belief = conclusion.belief;
  const KernelModel& model = conclusion.model.field.kernel;
  Kernel kernel = belief.prior().kernel();
  if (!model.length_m.is_learned() || kernel.length_m <= model.length_median_m) return belief;
  kernel.length_m = model.length_median_m;
  return Belief(belief.prior().with(kernel), belief.options()).condition_on(belief.palpations());
}

}  // namespace

Acquisition acquisition_in_force(const Conclusion& conclusion, const Plan& plan) {
  return conclusion.evidence.allows_boundary() && conclusion.level ? plan.acquisition
                                                                   : Acquisition(evr());
}

std::vector<int> chosen_stops(const Conclusion& conclusion, const Plan& plan, int done,
                              std::span<const int> candidates, const BatchOptions& options) {
  const Batching batch{conclusion, plan, candidates, options, std::max(plan.batches - done, 1)};
  const std::vector<int> lacking = lacking_stops(batch);
  if (!conclusion.evidence.contrast_seen) return searching_stops(batch, lacking);
  if (!conclusion.edge) return with_others(batch, {}, conclusion.belief);
  // Search first, then refine: from half the share to half as much again over the plan's batches.
  const double progress = static_cast<double>(done + 1) / std::max(plan.batches, 1);
  const int at_edge = static_cast<int>(
      std::lround(std::min(plan.aim.edge_share * (0.5 + progress), 1.0) * options.size));
  const int count = std::max(std::min(at_edge, options.size - due(batch, lacking)), 0);
  std::vector<int> stops;
  add_unexplained(batch, static_cast<std::size_t>(count), stops);
  add_softer_reach(batch, count - static_cast<int>(stops.size()), stops);
  add_apart(batch,
            conclusion.edge->most_telling(candidates, count - static_cast<int>(stops.size()),
                                          options.least_spacing_m, conclusion.marginals.variance),
            stops);
  add_second_look(batch, stops);
  add_apart(batch, lacking, stops);
  return with_others(batch, std::move(stops), searching_belief(conclusion));
}

}  // namespace palpation
