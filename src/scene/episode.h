/// A whole run over a scene, against a world that answers touches: what `simulate`, `replay` and
/// the experiments share.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpation/boundary/level_set.h"
#include "palpation/boundary/region_error.h"
#include "palpation/exploration/exploration.h"
#include "palpation/exploration/trace.h"
#include "scene/course.h"
#include "scene/scene.h"
#include "scene/stopwatch.h"

namespace palpation::tool {

/// Places that a run may touch: more would take hours and gigabytes, since the model's cost grows
/// with their third power.
inline constexpr int kMostPlaces = 10'000;

/// What answers, and what is known to be true of it.
struct World {
  Probe probe;
  Field truth;  ///< at the vertices
  double true_level = 0.0;
  std::string truth_is = "the truth";  ///< in words
  Reach reach{};
  std::vector<std::string> warnings{};  ///< what looks odd about it, a sentence each
};

/// The state after a batch.
struct Snapshot {
  Field mean, stddev, acquisition;
  Field score{}, probability_inside{};  ///< of certainty.h; empty while there is no level
  Field mean_detrended{};               ///< empty where no trend is modelled
  Field above_level{};  ///< what the boundary is the zero line of; empty while there is none
  /// The least diameter of a tumour around each vertex that would have been found; empty without a
  /// goal of the search.
  Field undetected_mm{};
};

struct Episode {
  Exploration exploration;
  Region estimate{};
  std::optional<Region> truth{};
  std::string truth_is{};                   ///< in words
  std::optional<Superlevel> plain_truth{};  ///< where errors are asked for in plain arithmetic
  std::optional<RegionError> error{};
  Trace trace{};
  Course course{};
  double cut_risk;  ///< of the cut line
  RunTimes seconds{};
  std::optional<std::string> coarse_stop_reason{};

  const Conclusion& conclusion() const { return exploration.conclusion(); }
  double band_probability() const { return conclusion().model.band.value_or(Band{}).probability; }
  /// Why nothing more is to be touched.
  const std::string& stop_reason() const {
    return coarse_stop_reason ? *coarse_stop_reason : exploration.stop_reason();
  }
};

using AfterBatch = std::function<void(const Episode&)>;

/// Whether the scene asks for a classical scan in place of batches.
bool is_scan(const Scene& scene);

/// Runs the scene's plan to its end. Pictures of intermediate states are the caller's, by
/// after_batch.
Episode run_episode(const Scene& scene, const Surface& surface, const World& world,
                    const AfterBatch& after_batch = {});

/// What is believed after measurements that were made elsewhere.
Episode episode_from(const Scene& scene, const Surface& surface,
                     std::span<const Palpation> palpations);

/// Where to go after those: what a run over the scene would touch next.
Choice next_of(const Scene& scene, const Surface& surface, const Episode& episode);

Snapshot snapshot(const Episode& episode);

/// The least diameter of a tumour that would have been found, with the band's probability: wherever
/// on the tissue where nothing was found, else outside of what was found. Its contrast is the
/// assumed one, else four times the scatter of the readings, or that of what was found. Nothing
/// without readings, where no size can be ruled out, or where something stiff is hidden by the
/// probe's tip.
std::optional<double> diameter_ruled_out_m(const Episode& episode);
inline constexpr std::size_t kMostTouchesCounted = 1000;
/// Where the scene has a goal for the search: how far it is from being reached.
struct GoalState {
  double diameter_m = 0.0;
  double probability = 0.95;
  std::optional<double> undetected_m{};  ///< diameter_ruled_out_m with that probability
  /// Further ones, kMostTouchesCounted at most, for all whose middle may be touched.
  std::size_t touches_needed = 0;

  /// As far as diameters are looked for.
  bool is_reached() const;
};
std::optional<GoalState> goal_state(const Episode& episode);
/// Those that are not set aside, the trend taken off.
std::vector<double> readings_that_count(const Exploration& exploration);
/// Their standard deviation, or that of a noise that is given, if it is greater; 0 where all are
/// alike.
double scatter(const Exploration& exploration);

}  // namespace palpation::tool
