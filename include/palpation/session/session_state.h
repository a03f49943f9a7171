/// All that a session's journal says: a value, which readers may have at any time.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

/// What a session is of, each in any words: equal words, equal plans.
struct SessionIdentity {
  std::string scene, tissue, version;
  bool operator==(const SessionIdentity&) const = default;
};

/// What a robot felt, as it came. Lengths are metres in the mesh's frame.
struct SessionReading {
  Vec3 place = Vec3::Zero();
  double reading = std::numeric_limits<double>::quiet_NaN();
  double noise_variance = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the field's noise
  TouchKind kind = TouchKind::Stop;
  Vec3 travel = Vec3::Zero();  ///< unit direction of travel, or zero if unknown
  std::optional<double> t_s{};
  std::optional<int> stop{};  ///< of the plan, from 0: which it answers; nothing: the nearest open
                              ///< stop within a millimetre along the tissue, if there is one
};

/// A ball where nothing is to be touched.
struct KeepOut {
  Vec3 centre = Vec3::Zero();
  double radius_m = 0.0;
};

/// What a plan follows from, and nothing else.
struct SessionQuestion {
  std::string measurements_csv;     ///< as measurements.h reads it
  std::vector<Vec3> touch_first{};  ///< places that a person asked for
  std::vector<KeepOut> keep_out{};  ///< by a person
};

/// Where to touch, as it is handed out.
struct SessionPlan {
  std::vector<Vec3> stops{};  ///< on the tissue, in the order of travel; empty: finished
  std::string stop_reason{};  ///< why there are none
  std::string waypoints_csv{}, path_csv{};  ///< poses for the robot
};

enum class StopState {
  Open,
  Touched,
  Missed,
  Dropped  ///< with its plan, when the session went on with another scene
};

struct HandedOut {
  int number = 0;  ///< from 0
  int batch = 0;   ///< of its readings
  SessionPlan plan{};
  std::vector<StopState> stops{};  ///< what became of them
  std::string used{};              ///< the rows that it was made from, such as "1-16,18-30"
};

/// A reading, or a stop that could not be touched.
struct SessionRow {
  SessionReading made{};
  int plan = -1;  ///< in whose time it came; -1: before the first
  int batch = 0;
  std::string off_tissue{};  ///< why it is not used at all; empty: it lies on the tissue
  std::string withdrawn{};   ///< why a person took it back; empty: it counts
  std::string why{};         ///< of a stop that could not be touched
};

struct SessionState {
  SessionIdentity identity{};
  std::vector<SessionRow> rows{};  ///< number 1 first
  std::vector<HandedOut> plans{};
  std::vector<Vec3> touch_first{};  ///< asked for, and not handed out yet
  std::vector<KeepOut> keep_out{};
  std::vector<std::string> refusals{};
  bool has_news = false;  ///< something came since the last plan

  /// The stops of the last plan that nothing has become of yet.
  std::vector<int> open_stops() const;
};

/// The rows that count for a plan made now, as measurements.csv has them, with columns number,
/// withdrawn and t behind. Readings off the tissue are left out.
std::string measurements_csv(const SessionState& state);
SessionQuestion question_of(const SessionState& state);

/// What a session's folder holds, its writer running or not; up to the moment before a plan was
/// made, if one is named. Throws IoError as Session does, and where there is no such plan.
SessionState read_session(const std::filesystem::path& folder,
                          std::optional<int> before_plan = std::nullopt);

}  // namespace palpation
