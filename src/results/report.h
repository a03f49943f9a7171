/// report.html: all that a run tells, in one file that asks nobody for anything.
///
/// In the order in which people want it: the verdict with its warnings and its scope; the tissue in
/// 3-D, or where a browser cannot draw it the pictures; figures; readings; where it comes from. All
/// words and figures stand in the page itself, so that it reads without its script. Its policy lets
/// no browser load anything: script and style are those whose hashes it names.
#pragma once

#include <string>

#include "results/run.h"
#include "results/verdict.h"

namespace palpation::results {

/// What the run's record says of it.
struct Origin {
  std::string version;  ///< of the program that made the page
  std::string command;
  RunState state;
};

/// The page. Pictures are those in the run's folder, if there are any. Throws IoError as read_run
/// does, or where the tissue has no field `mean`.
std::string report_html(const Run& run, const Origin& origin);

}  // namespace palpation::results
