/// Readings from a sensor that keeps its own indentation or force, such as a spring-loaded probe
/// that is dragged over the tissue: each sample is a reading already, in newtons or in counts.
///
/// Samples are gathered over a stretch of travel: the reading is their mean, its place theirs. The
/// variance is that of the mean: the scatter about a line over the way, times (1 + r) / (1 - r) for
/// samples whose errors follow each other with correlation r (of neighbours, over the whole log),
/// over their number, by Student's t as in fit_contact; not known where r exceeds .4, as behind a
/// filter that is slower than a stretch. Samples farther apart than a stretch are
/// readings of their own (single pokes), whose variance is not known.
///
/// Stretches break at gaps in time, at jumps of more than 5 mm and where the probing's name (a scan
/// line) or the session changes. A stretch whose samples all hold one value, to the last digit,
/// while the probe moves by half of it or more, is stuck, as are five or more pokes in a row: no
/// reading comes of them.
#pragma once

#include "palpation/probing/robot_log.h"

namespace palpation {

struct ScanOptions {
  double every_m = 0.001;  ///< of travel, a reading
};

/// Throws InvalidInput without samples, positions and a force or count, or unless every_m is
/// positive and finite.
ProbedLog scan_readings(const RobotLog& log, const ScanOptions& options = {});

}  // namespace palpation
