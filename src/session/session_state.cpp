#include "palpation/session/session_state.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/measurement_columns.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"
#include "session/entries.h"
#include "session/journal.h"

namespace palpation {
namespace {

std::string kind_word(TouchKind kind) {
  if (kind == TouchKind::Missed) return "missed";
  return kind == TouchKind::Way ? "way" : "stop";
}

/// As the column `withdrawn` has it: a reason that reads as "it was not" is none.
std::string withdrawn_cell(const std::string& why) {
  constexpr std::array<std::string_view, 3> kNo = {"0", "no", "false"};
  return std::ranges::find(kNo, why) != kNo.end() ? "yes" : why;
}

std::vector<std::string> cells_of(const SessionRow& row, std::size_t number) {
  const SessionReading& made = row.made;
  const bool was_missed = made.kind == TouchKind::Missed;
  const auto travel = [&](int i) {
    return made.travel.isZero(0.0) ? std::string() : text_of(made.travel[i]);
  };
  return {text_of(made.place.x()),
          text_of(made.place.y()),
          text_of(made.place.z()),
          was_missed ? std::string() : text_of(made.reading),
          std::isnan(made.noise_variance) ? std::string() : text_of(made.noise_variance),
          std::to_string(row.batch),
          kind_word(made.kind),
          travel(0),
          travel(1),
          travel(2),
          std::string(),
          withdrawn_cell(row.withdrawn),
          made.t_s ? text_of(*made.t_s) : std::string(),
          std::to_string(number)};
}

}  // namespace

std::vector<int> SessionState::open_stops() const {
  std::vector<int> open;
  if (plans.empty()) return open;
  const std::vector<StopState>& stops = plans.back().stops;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (stops[i] == StopState::Open) open.push_back(static_cast<int>(i));
  }
  return open;
}

std::string measurements_csv(const SessionState& state) {
  std::vector<std::string> header(kMeasurementColumns.begin(), kMeasurementColumns.end());
  for (const char* column : {"withdrawn", "t", "number"}) header.emplace_back(column);
  std::string text = csv_line(header);
  for (std::size_t i = 0; i < state.rows.size(); ++i) {
    if (state.rows[i].off_tissue.empty()) text += csv_line(cells_of(state.rows[i], i + 1));
  }
  return text;
}

SessionQuestion question_of(const SessionState& state) {
  return {measurements_csv(state), state.touch_first, state.keep_out};
}

SessionState read_session(const std::filesystem::path& folder, std::optional<int> before_plan) {
  const std::filesystem::path path = folder / kJournalName;
  SessionState state;
  for (const nlohmann::json& entry : parse_journal(read_file(path), path.string()).lines) {
    if (before_plan && plan_number_of(entry) == *before_plan) return state;
    apply(state, entry, path.string());
  }
  if (before_plan)
    throw IoError(path.string() + ": has no plan " + std::to_string(*before_plan) + ", but " +
                  std::to_string(state.plans.size()) + " plans, from 0");
  return state;
}

}  // namespace palpation
