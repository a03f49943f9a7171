/// Readings that are no tissue: found, and set aside with the reason.
///
/// A probe jams (its spring sticks, and all it says is far too high), hangs (the same number again
/// and again), loses contact (far too low, and flat), wakes up from rest, slips once, is seated
/// anew between two rows, or tells in another unit or with another sign all at once. What a screen
/// may rely on is physical:
///   - an edge felt through a tip of several millimetres is felt over millimetres: between tissue's
///   levels there are readings, between
///     those of tissue and of a jam next to none;
///   - over a path longer than the tip is wide a working sensor does not say the same number to its
///   last digit more often than by chance, unless that is the end of its range;
///   - a scan's row crosses more tissue than tumour, so that its lower readings are the healthy
///   tissue's, alike from row to row;
///   - rows that start from rest all start in the same way;
///   - a reading is like those around it, the more so the nearer they are, and the more alike the
///   directions of travel;
///   - contact is lost here and there, not over the one part of the tissue that is soft.
/// All scales are those of the readings themselves. The rules about rows hold only for scans: rows
/// that each cross most of the tissue; the others for any readings. A stiff place that was felt
/// once is no outlier: its neighbours are too far away to contradict it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Reasons, as they stand in `set_aside`.
inline const std::string kJammed = "jam: far above all other readings";
inline const std::string kNoContact =
    "no contact: far below all other readings, or a row without any change";
inline const std::string kNoLogarithm = "no logarithm: not positive";
inline const std::string kFrozen =
    "frozen: the same reading over a path longer than the probe is wide";
inline const std::string kAnotherUnit =
    "another unit: of another sign than the others of its session, or 100 times as large or small; "
    "name it another session";
inline const std::string kStartUp = "start-up: the first 3 mm of a row that starts from rest";
inline const std::string kOutlier = "outlier: contradicts the readings around it";
inline const std::string kBaseStep = "base step: its row lies apart from the rows around it";
inline const std::string kStandsAlone =
    "stands alone: farther from all other readings than they from each other";  ///< Exploration's
inline const std::string kBeyondTissue =
    "beyond the tissue: where it was felt none lay before it moved";  ///< Exploration's

inline const std::string kSoftSpot =
    "soft spot: below nearly all of the tissue, which is taken for healthy, not for tumour";  ///< Exploration's

/// Reasons that are found in any readings, and in those of a scan's rows alone.
inline const std::array kReasonsAnywhere = {kNoContact, kNoLogarithm,  kFrozen,  kAnotherUnit,
                                            kOutlier,   kBeyondTissue, kSoftSpot};
inline const std::array kReasonsOfScans = {kJammed, kStartUp, kBaseStep};

/// As fine as anything is felt with a tip of 4.5 mm.
inline constexpr double kShortLength_m = 0.0035;

/// The same readings, in the order in which they were made and as the sensor told them, with those
/// set aside that are frozen, unless all are alike, or in another unit than others of their
/// session.
std::vector<Palpation> live(const Surface& surface, std::span<const Palpation> palpations);

/// The same readings, with those set aside that no tissue gives whatever the order in which they
/// were made: far below all others, or contradicted by those around them. What was set aside
/// before stays so and tells nothing. `length_m`: over which stiffness changes, at least.
std::vector<Palpation> plausible(const Surface& surface, std::span<const Palpation> palpations,
                                 double length_m = kShortLength_m);

/// The same readings, in the order in which they were made, with what is no tissue set aside:
/// faults of rows and of the sensor's time first, then as `plausible`. What
/// was set aside before stays so and tells nothing. The same readings without reasons give the same
/// answer, however often.
std::vector<Palpation> screened(const Surface& surface, std::span<const Palpation> palpations);

}  // namespace palpation
