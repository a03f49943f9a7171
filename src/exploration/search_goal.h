/// What a search would have found besides what it found, and what it takes to be surer.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "certainty/detection.h"
#include "palpation/exploration/conclusion.h"
#include "palpation/exploration/plan.h"

namespace palpation {

/// A tumour that is not found yet, and where it may be.
struct Search {
  Sought sought;
  std::vector<int> centres{};  ///< rising: where nothing was found
};

/// Of the model's least contrast, else that of what was found, else four times the readings'
/// scatter, whatever that will be. Nothing where all readings are alike (a stuck sensor rules
/// nothing out), or where something stiff is hidden by the probe's tip.
std::optional<Search> search_after(const Conclusion& conclusion, double probability);

/// The least diameter of a tumour that it would have found. Nothing where no size smaller than the
/// tissue can be ruled out.
std::optional<double> diameter_ruled_out_m(const Conclusion& conclusion, double probability);

/// The same wherever its centre may be, at the vertices, 0 where something was found; empty where
/// nothing can be said.
Field diameters_undetected_m(const Conclusion& conclusion, double probability);

/// Of the readings that count, the trend taken off, on the conclusion's scale: their standard
/// deviation, or that of a noise that is given, if it is greater; 0 where all are alike.
double scatter_of(const Conclusion& conclusion);

/// The model's least contrast on the conclusion's scale: of logarithms it is given as a factor.
double contrast_on_scale(const Conclusion& conclusion, double least);

/// Where else to touch, one after the other, so that a tumour of the goal's diameter would be found
/// with its probability wherever its centre may be touched, which is at the `candidates`, rising:
/// `most` at most, and none where that is so already.
std::vector<int> stops_to_goal(const Conclusion& conclusion, const Aim& aim,
                               std::span<const int> candidates, std::size_t most);

}  // namespace palpation
