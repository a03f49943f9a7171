/// Readings from single indentations: a log of probings to stiffness at their contact points.
///
/// Probings are told apart by the log's own names or, where it has none, by contact: episodes of
/// force above the sensor's zero (a line in time, which the lower samples follow) by a threshold of
/// six times its noise and a tenth of the usual peak, each with its approach: back to where the
/// probe came from.
///
/// The axis of a probing is the log's mean normal or, where it has none, the line along which the
/// probe moved in. Depth is the log's own or the way along the axis; the force is the log's own, or
/// its component along the axis. How a robot counts, pressing positive or negative and normals in
/// or out, shows in the whole log: more force where it is deeper in most probings. Each is fitted
/// by fit_contact; whether probings begin in the air is decided for all together, by most of them.
///
/// The place is, in this order: the contact point that the log names; where the probe was at the
/// contact depth, if the fit found that in the air; where it was at the shallowest sample, or,
/// without contact, at the deepest.
///
/// A probing that fails is reported with its reason, missed if there was no contact; so is one
/// whose depths or value are 300 times those of most, or a 300th: it is in another unit.
#pragma once

#include "palpation/probing/indentation.h"
#include "palpation/probing/robot_log.h"

namespace palpation {

/// Groups of samples, each in the log's order. With names: one a name and session, and one each
/// visit, where the log comes back to a name after more than five rows of others. Without: see
/// above; needs a force and depths or positions.
std::vector<std::vector<Eigen::Index>> probings_in(const RobotLog& log);

/// Readings are in the force's unit per millimetre (Linear), kPa (Hertz, where the force is in
/// newtons; else its unit per mm2) or the force's unit (ForceAtDepth). Throws InvalidInput without
/// force and positions, without samples, where most probings span more than 0.2 m, and as
/// fit_contact.
ProbedLog probing_readings(const RobotLog& log, const ContactOptions& options = {});

}  // namespace palpation
