// Charts from tables: which columns are curves, and what a run's trace shows.
#include <algorithm>
#include <cmath>

#include "draw/chart.h"

namespace palpation::draw {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::size_t count_of_numbers(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::count_if(values.begin(), values.end(),
                                                [](double value) { return std::isfinite(value); }));
}

}  // namespace

Chart chart_of(const Table& table) {
  Chart chart;
  const std::vector<std::string>& names = table.names();
  chart.x_label = names.front();
  chart.x = table.numbers(names.front());
  for (std::size_t i = 1; i < names.size(); ++i) {
    const bool belongs_to_another =
        ends_with(names[i], "_se") && table.has(names[i].substr(0, names[i].size() - 3));
    if (belongs_to_another) continue;
    const std::string errors = names[i] + "_se";
    chart.curves.push_back({names[i], table.numbers(names[i]),
                            table.has(errors) ? table.numbers(errors) : std::vector<double>{}});
  }
  return chart;
}

std::optional<Chart> convergence_of(const Table& trace) {
  const std::vector<double> error = trace.numbers("error_percent");
  const std::vector<double> level = trace.numbers("level");
  const bool with_error = count_of_numbers(error) > 0;
  const std::vector<double>& shown = with_error ? error : level;
  const std::vector<double> measurements = trace.numbers("measurements");
  if (std::min(count_of_numbers(measurements), count_of_numbers(shown)) < 2) return std::nullopt;
  return Chart{
      .title = with_error ? "Error of the estimated boundary" : "Estimated level of the boundary",
      .x_label = "measurements",
      .y_label = with_error ? "symmetric difference [% of the search area]"
                            : "level [unit of the readings]",
      .x = measurements,
      .curves = {{with_error ? "error" : "level", shown, {}}}};
}

}  // namespace palpation::draw
