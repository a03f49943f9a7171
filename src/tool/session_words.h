/// A session in plain words.
#pragma once

#include <string>
#include <vector>

#include "palpation/session/session_state.h"

namespace palpation::tool {

/// "3 stops are open: 0, 4 and 7.".
std::string open_words(const SessionState& state);
/// The stops of the last plan and what became of them, in the mesh's frame; why there are none.
std::string plan_in_words(const HandedOut& plan);
/// All that there is to know.
std::string session_in_words(const SessionState& state);

/// Readings and missed stops of a CSV file with the columns of measurements.h, and `index` for the
/// stop that a row answers. Throws IoError naming the line.
struct ToldRow {
  int line = 0;  ///< of the file
  SessionReading reading;
  bool is_set_aside = false;  ///< or withdrawn, as the file says
};
/// Of a file whose readings are in this unit; empty: in any one.
std::vector<ToldRow> read_told(const std::string& path, const std::string& reading_unit);

}  // namespace palpation::tool
