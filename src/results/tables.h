/// Tables of a run for spreadsheets: millimetres, and units in the names of the columns.
#pragma once

#include <map>
#include <string>

#include "results/run.h"

namespace palpation::results {

/// tissue.csv, touches.csv, boundary.csv, parts.csv, next_stops.csv, batches.csv: those that there
/// is something to write in.
std::map<std::string, std::string> tables_of(const Run& run);

}  // namespace palpation::results
