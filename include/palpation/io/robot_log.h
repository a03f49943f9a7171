/// A robot's log from a table: which column is what, in which unit.
///
/// A column's name says its role and its unit: `depth [mm]`, `force_N`, `x(mm)`, `fx_n`, `time_ms`,
/// `pose.position.x`. Upper and lower case, and blanks, dots and slashes for underscores, are
/// alike.
///
///   role                    known by (see log_roles)                  units
///   time                    t, time, stamp, timestamp, ...            s, ms, us, ns, min
///   x, y, z                 x, pos_x, position_x, tip_x, ...          mm, cm, m, um
///   depth                   depth, indentation, displacement, ...     the same
///   force                   force, f, fn, normal_force, ...           N, mN, uN, kN, gf, kgf,
///   counts fx, fy, fz              fx, force_x, wrench_force_x, ...          the same count count,
///   counts, adc, raw, reading, sensor  counts: a force without a unit nx, ny, nz              nx,
///   normal_x, n_x                         none contact_x, ...          contact_x, surface_x,
///   touch_x, ...        as x probe                   probe, probing, poke, probe_id, row ...   a
///   name or number sample                  sample, index, seq                        the order
///   within a probing session                 session, run                              a name
///
/// Two columns for one role are refused with both their names, as are a force along the normal
/// beside one in components, and a length, force or time without a unit: rules name what is meant.
/// z may be missing, and is 0 then. Columns of no role are ignored.
///
/// An empty cell, nan, na, n/a, null, none, - and infinite numbers are samples not recorded. A cell
/// that is no number otherwise, a number beyond what a probe can do (1 km, 1e12 of a force) and a
/// row with more or fewer cells than the header leave out their row, with a remark that names the
/// lines. Rows that repeat the row before to every character are left out and told.
///
/// Times go on. A row whose stamp lies before the last one's, by no more than ten usual steps or
/// for fewer than ten rows, was swapped: rows are put in order, and told. Else the clock was set
/// anew, or another log begins: told, and what follows is moved on in time, behind a gap. Within a
/// probing without times the column sample orders rows. Stamps that are 0 or not there, beside
/// others that are, leave out their row.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpation/probing/robot_log.h"

namespace palpation {

struct LogRules {
  std::map<std::string, std::string> columns{};  ///< role to the name of its column
  std::map<std::string, std::string> units{};    ///< time, position, depth or force to its unit
  double gain = 0.0;                             ///< newtons a count; 0: none, counts stay counts
  double offset = 0.0;                           ///< counts at no force
  std::string session{};                         ///< of all rows; empty: the column's
};

struct LogFile {
  RobotLog log;
  std::vector<std::string> remarks;  ///< which column was taken for what; what was left out
  bool names_probings = false;
  bool has_depth = false;
  bool counts_only = false;  ///< the force is a raw count, for which no gain was given
};

/// The roles and, of each, the names by which it is known.
const std::vector<std::pair<std::string, std::vector<std::string>>>& log_roles();

/// Throws IoError naming file, line, column and rule for a header that does not say what is what,
/// and where no row is left; InvalidInput for rules that name no role, no quantity or no unit.
LogFile read_robot_log(const std::filesystem::path& path, const LogRules& rules = {});
LogFile parse_robot_log(std::string_view text, const std::string& name, const LogRules& rules = {});

/// Readings as a table of measurements: x,y,z [m], reading, noise_variance, batch, kind, tx,ty,tz,
/// set_aside, t, session, withdrawn, then reading_unit, nx,ny,nz, contact, probing and the log's
/// line. What was missed is a row of that kind, without a reading, so that it is not planned again;
/// what else failed is not in it.
std::string probed_csv(const ProbedLog& result);
/// What failed: x,y,z [m], t, session, probing, line, kind (missed: the probe came and touched
/// nothing; else empty), reason.
std::string left_out_csv(const ProbedLog& result);

}  // namespace palpation
