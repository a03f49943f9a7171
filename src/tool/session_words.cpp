#include "tool/session_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/measurement_rows.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kMm = 1e3;  // in a metre

std::string listed(const std::vector<int>& numbers) {
  std::string words;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    words += (i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ") + std::to_string(numbers[i]);
  return words;
}

std::string state_word(StopState state) {
  if (state == StopState::Touched) return "touched";
  if (state == StopState::Missed) return "missed";
  return state == StopState::Open ? "open" : "dropped";
}

double number_in(const CsvTable& table, std::size_t row, std::string_view name, double otherwise) {
  const auto column = find_column(table, name);
  if (!column || table.cell(row, *column).empty()) return otherwise;
  return finite_number_at(table, row, *column);
}

std::optional<int> stop_in(const CsvTable& table, std::size_t row) {
  const auto column = find_column(table, "index");
  if (!column || table.cell(row, *column).empty()) return std::nullopt;
  const auto stop = parse_integer(table.cell(row, *column));
  if (!stop || *stop < 0 || *stop > 1'000'000)
    fail_at_cell(table, row, *column, "must be empty, or the index of a stop of the plan");
  return static_cast<int>(*stop);
}

TouchKind kind_in(const CsvTable& table, std::size_t row) {
  const auto column = find_column(table, "kind");
  const std::string_view word = column ? table.cell(row, *column) : std::string_view();
  if (word.empty() || word == "stop") return TouchKind::Stop;
  if (word == "way") return TouchKind::Way;
  if (word == "missed") return TouchKind::Missed;
  fail_at_cell(table, row, *column, "must be stop, way, missed or empty");
}

SessionReading told_in(const CsvTable& table, std::size_t row) {
  SessionReading told{.kind = kind_in(table, row), .stop = stop_in(table, row)};
  if (told.kind == TouchKind::Missed) {
    if (!told.stop)
      fail_at_row(table, row, "a missed stop is named by a column index: which stop of the plan");
    return told;
  }
  const auto at = [&](const char* name) {
    return finite_number_at(table, row, column_index(table, name));
  };
  told.place = Vec3(at("x"), at("y"), at("z"));
  told.reading = at("reading");
  told.noise_variance = number_in(table, row, "noise_variance", told.noise_variance);
  told.travel = Vec3(number_in(table, row, "tx", 0.0), number_in(table, row, "ty", 0.0),
                     number_in(table, row, "tz", 0.0));
  if (!told.travel.isZero(0.0) && std::abs(told.travel.norm() - 1.0) > 1e-12)
    told.travel = told.travel.stableNormalized();
  const double never = std::nan("");
  if (const double t = number_in(table, row, "t", never); !std::isnan(t)) told.t_s = t;
  return told;
}

}  // namespace

std::string open_words(const SessionState& state) {
  const std::vector<int> open = state.open_stops();
  if (state.plans.empty()) return "There is no plan yet: ask for the next one.\n";
  if (open.empty())
    return state.plans.back().stops.empty() && !state.has_news
               ? "The session is finished.\n"
               : "Nothing is open: ask for the next plan.\n";
  return counted(open.size(), "stop") + (open.size() == 1 ? " is" : " are") +
         " open: " + listed(open) + ".\n";
}

std::string plan_in_words(const HandedOut& plan) {
  if (plan.stops.empty())
    return "Plan " + std::to_string(plan.number) +
           ": nothing more to touch: " + plan.plan.stop_reason + ".\n";
  std::string words = "Plan " + std::to_string(plan.number) + ", from the rows " +
                      (plan.used.empty() ? "(none)" : plan.used) +
                      ": touch in this order, in the mesh's frame [mm]:\n";
  for (std::size_t i = 0; i < plan.stops.size(); ++i) {
    const Vec3 mm = plan.plan.stops[i] * kMm;
    words += "  " + std::to_string(i) + ":  " + fixed(mm.x(), 2) + "  " + fixed(mm.y(), 2) + "  " +
             fixed(mm.z(), 2);
    words += plan.stops[i] == StopState::Open ? "\n" : "  (" + state_word(plan.stops[i]) + ")\n";
  }
  return words;
}

std::string session_in_words(const SessionState& state) {
  std::vector<int> withdrawn, off, missed;
  for (std::size_t i = 0; i < state.rows.size(); ++i) {
    const SessionRow& row = state.rows[i];
    const int number = static_cast<int>(i) + 1;
    if (row.made.kind == TouchKind::Missed) missed.push_back(number);
    if (!row.withdrawn.empty()) withdrawn.push_back(number);
    if (!row.off_tissue.empty()) off.push_back(number);
  }
  std::string words = counted(state.plans.size(), "plan") + " handed out, " +
                      counted(state.rows.size() - missed.size(), "reading") + " taken";
  const auto add = [&](const std::vector<int>& numbers, const std::string& what) {
    if (!numbers.empty())
      words += "; " + std::to_string(numbers.size()) + " " + what + " (" + listed(numbers) + ")";
  };
  add(missed, "not to be touched");
  add(withdrawn, "withdrawn");
  add(off, "off the tissue");
  words += ".\n";
  for (const KeepOut& ball : state.keep_out)
    words += "Keep out: " + fixed(ball.radius_m * kMm, 2) + " mm around " +
             place_words(ball.centre, 2) + ".\n";
  for (const Vec3& place : state.touch_first)
    words += "To be touched first in the next plan: " + place_words(place, 2) + ".\n";
  for (const std::string& refusal : state.refusals) words += "Refused: " + refusal + "\n";
  if (!state.plans.empty()) words += plan_in_words(state.plans.back());
  return words + open_words(state);
}

namespace {

/// A folder is one session: zeros of their own, which others would have, are not kept.
void check_session(const CsvTable& table) {
  const std::optional<std::size_t> column = find_column(table, "session");
  for (std::size_t row = 1; column && row < table.row_count(); ++row) {
    if (table.cell(row, *column) != table.cell(0, *column))
      fail_at_cell(table, row, *column,
                   "is another session than " + in_quotes(table.cell(0, *column)) +
                       " in the rows above: a folder is one session; several are for palpate "
                       "boundary --measurements");
  }
}

}  // namespace

std::vector<ToldRow> read_told(const std::string& path, const std::string& reading_unit) {
  const CsvTable table = read_csv(path);
  check_reading_unit(table, reading_unit);
  check_session(table);
  std::vector<ToldRow> rows;
  for (std::size_t row = 0; row < table.row_count(); ++row)
    rows.push_back({table.line(row), told_in(table, row), !set_aside_at(table, row).empty()});
  return rows;
}

}  // namespace palpation::tool
