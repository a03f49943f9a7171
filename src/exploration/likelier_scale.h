/// Whether readings are told better by their logarithms.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exploration/as_if_unchanged.h"

namespace palpation {

/// As the scale has it.
Model on_scale(ReadingScale scale, Model model);

struct KnownOnScale {
  ReadingScale scale = ReadingScale::Raw;
  std::vector<Palpation> felt;  ///< on that scale
  Known known;                  ///< known_beside_soft_spot
};

struct LikelierScale {
  KnownOnScale likelier;
  /// By logarithms, where readings do not tell which: those as they are move nothing.
  std::optional<KnownOnScale> other{};
};

/// On the model's scale; where that is open, on that which makes the readings more probable by an
/// edge between two plateaus, with even noise about it: a field's own evidence would prefer
/// logarithms of any plateaus. While touches are planned, and on tissue without a chart, the edge
/// tells, and is surprised by logarithms or there are none; with a seed outlines tell, and may
/// leave it open. Where one scale alone has an edge, on that. Readings are as they are where a
/// value of the model is in their unit, the sensor's range ended, more than a few have no
/// logarithm, or none is twice as high as another of its session.
LikelierScale on_likelier_scale(const Surface& surface, const Model& model,
                                const std::vector<Palpation>& felt, ConclusionCache& cache,
                                std::optional<std::uint64_t> sampling_seed);

}  // namespace palpation
