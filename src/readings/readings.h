/// The readings that count, which are those that were made and are not set aside, and how they
/// spread.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Of the palpations that count, in their order.
std::vector<double> used_readings(std::span<const Palpation> palpations);

/// When one of a list was made: its number is Palpation::number, or its place in the list.
Made made_of(std::span<const Palpation> palpations, std::size_t place);

/// Places in the list of those that count, as they were made (is_since of misfit.h), a batch after
/// the other; evenly thinned to at most so many.
std::vector<std::size_t> in_time(std::span<const Palpation> palpations, std::size_t most);

/// Readings that count with their places in space, metres, a row each.
struct PlacedReadings {
  Eigen::MatrixX3d places;
  Eigen::VectorXd readings;
};
PlacedReadings placed_readings(const Surface& surface, std::span<const Palpation> palpations);

bool all_equal(std::span<const double> readings);

/// Mean and standard deviation (of all, not of a sample), as BeliefOptions::standardize takes them;
/// sd is 0 where all are alike.
struct Spread {
  double mean = 0.0;
  double sd = 0.0;
};
/// Needs a reading.
Spread spread_of(std::span<const double> readings);

/// The part of the readings' variance, 0 to 1, that the best plane over their places in space
/// explains (least squares); 0 for fewer than fifteen readings, where chance explains much, and
/// where all are alike.
double explained_by_plane(const Surface& surface, std::span<const Palpation> palpations);

}  // namespace palpation
