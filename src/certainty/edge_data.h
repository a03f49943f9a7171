/// The readings as a boundary's fit takes them: one per place, with its depth.
#pragma once

#include "certainty/edge_fit.h"
#include "certainty/layout.h"
#include "palpation/belief/belief.h"

namespace palpation {

/// More places than this are many; beyond so deep an edge of any slope in the prior is over (98 %
/// at 500 per metre).
inline constexpr Eigen::Index kMany = 300;

/// One reading per place, of those that are used; depths are still to be measured.
EdgeData gathered_for_edge(const Belief& belief);
/// The same of the belief's readings `one_by_one`, where it knows some of them together.
EdgeData gathered_for_edge(const Belief& belief, std::vector<Palpation> one_by_one);

/// Of the same readings as one plateau and noise of which nothing is known but how many readings
/// each is the mean of, as EdgeBelief::log_evidence is: without what depends on their number alone,
/// less Schwarz's price of two constants.
double log_evidence_without_edge(const Belief& belief);

/// The same with noise of so many times the variance.
EdgeData with_noise(double times, EdgeData data);

/// Signed distances of the vertices and of the readings from { field = level }; false where there
/// is no boundary.
bool measure_depths(const Layout& layout, const Field& field, double level,
                    Eigen::VectorXd& vertices, EdgeData& data);

/// Where there are many, the readings deep on one plateau as one in each cell of some millimetres,
/// at their mean depth: they tell of the plateau alone, and the fit costs the third power of their
/// number.
EdgeData with_plateaus_merged(const Layout& layout, const EdgeData& data);

/// The mean direction in which the probe came to readings that are one.
Vec3 travel_to(const std::vector<Made>& made);

/// How far a plateau may lie from the least or greatest of the belief's mean, whose range this is,
/// in reading units: noise draws the mean in, so half of the contrast, which is the field's own
/// standard deviation.
double plateau_sd(const Belief& belief, double range);

}  // namespace palpation
