/// What a robot recorded while it palpated, and what became of it: samples in, readings out.
///
/// Plain data. Metres and seconds, not-a-number where nothing was recorded; columns that a log does
/// not have are empty. The force is in newtons or in counts, as force_unit says; as three
/// components or as one along the normal; pressing may be either sign, and normals may point in or
/// out: what belongs together shows in the whole log.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "palpation/base/types.h"

namespace palpation {

struct RobotLog {
  std::vector<int> line;             ///< of the file, for messages; a sample each
  Eigen::VectorXd time_s;            ///< n, or none
  Points position_m;                 ///< n x 3
  Eigen::VectorXd depth_m;           ///< n, into the tissue; or none
  Points force;                      ///< n x 3, or none
  Eigen::VectorXd force_along;       ///< n, the force along the normal; or none
  Points normal;                     ///< n x 3, or none
  Points contact_m;                  ///< n x 3, where the robot found the surface; or none
  std::vector<int> probing;          ///< n, the number of a name; or none: not told
  std::vector<std::string> names;    ///< of probings
  std::vector<std::string> session;  ///< n, or none
  std::string force_unit = "N";

  Eigen::Index size() const { return static_cast<Eigen::Index>(line.size()); }
};

/// What one probing, or one window of a slide, gave: a reading, or the reason why none.
struct Probed {
  Vec3 place_m = Vec3::Zero();
  double reading = std::numeric_limits<double>::quiet_NaN();
  double noise_variance = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  double time_s = std::numeric_limits<double>::quiet_NaN();          ///< NaN: not known
  Vec3 travel = Vec3::Zero();  ///< unit direction of travel; zero: none, or not known
  Vec3 normal = Vec3::Zero();  ///< unit, out of the tissue; zero: not known
  std::string contact{};  ///< how contact was known: "from the air", "all in contact", "sliding";
                          ///< "none" where there was none
  std::string probing{};  ///< its name in the log, or its number
  std::string session{};
  int line = 0;            ///< of the log, its first
  bool is_missed = false;  ///< the probe came, and touched nothing
  std::string reason{};    ///< why there is no reading; empty: there is one
};

struct ProbedLog {
  std::vector<Probed> probed;        ///< readings and failures, in the order of the log
  std::string unit;                  ///< of the readings
  std::vector<std::string> remarks;  ///< plain sentences: what was found, taken and left out
};

}  // namespace palpation
