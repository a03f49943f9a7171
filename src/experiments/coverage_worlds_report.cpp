// What experiment coverage --world says of its rows.
#include <algorithm>
#include <array>
#include <cstdio>

#include "experiments/coverage.h"
#include "experiments/experiment.h"
#include "palpation/base/error.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr std::size_t kBins = 10;

using Flags = std::vector<bool>;

int count_of(const Flags& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

std::string part_text(const Flags& flags) {
  if (flags.empty()) return "-";
  return fixed(100.0 * count_of(flags) / static_cast<double>(flags.size()), 0) + " %";
}

std::string part_csv(const Flags& flags) {
  if (flags.empty()) return ",,,";
  const Interval interval = wilson_interval(count_of(flags), static_cast<int>(flags.size()));
  return std::to_string(flags.size()) + "," +
         text_of(count_of(flags) / static_cast<double>(flags.size())) + "," +
         text_of(interval.low) + "," + text_of(interval.high);
}

/// What is said of some of the runs.
struct Summary {
  std::vector<double> over_bound, widths, true_over_expected;
  Flags covered, above_two, above_three_unsaid, missed, of_nothing;

  void add(const Figures& run) {
    const bool found = run.flag("found");
    if (!run.flag("has_tumour")) {
      of_nothing.push_back(found);
      return;
    }
    of_nothing.push_back(run.number("false_parts") > 0.0);
    missed.push_back(run.number("missed_parts") > 0.0);
    over_bound.push_back(run.number("error_mm2") / run.number("bound_mm2"));
    covered.push_back(run.flag("covered"));
    if (!found) {
      above_two.push_back(true);
      return;
    }
    widths.push_back(run.number("half_width_mm") / run.number("bound_half_width_mm"));
    const double ratio = run.number("error_mm2") / run.number("expected_error_mm2");
    true_over_expected.push_back(ratio);
    above_two.push_back(ratio > 2.0);
    above_three_unsaid.push_back(ratio > 3.0 && run.number("warnings") == 0.0);
  }
};

std::string number_or_dash(const std::vector<double>& values, bool is_median) {
  if (values.empty()) return "-";
  return fixed(is_median ? median(values) : statistics(values).mean, 2);
}

std::string print_row(const std::string& name, std::span<const Figures> runs) {
  Summary all;
  for (const Figures& run : runs) all.add(run);
  std::printf("%-17s%5zu%9s%10s%9s%9s%9s%9s%10s%9s%9s\n", name.c_str(), runs.size(),
              number_or_dash(all.over_bound, false).c_str(),
              number_or_dash(all.over_bound, true).c_str(), part_text(all.covered).c_str(),
              number_or_dash(all.widths, false).c_str(),
              number_or_dash(all.true_over_expected, true).c_str(),
              part_text(all.above_two).c_str(), part_text(all.above_three_unsaid).c_str(),
              part_text(all.missed).c_str(), part_text(all.of_nothing).c_str());
  const auto csv_median = [](const std::vector<double>& values) {
    return values.empty() ? std::string() : text_of(median(values));
  };
  return name + "," + std::to_string(runs.size()) + "," +
         (all.over_bound.empty() ? std::string() : text_of(statistics(all.over_bound).mean)) + "," +
         csv_median(all.over_bound) + "," + part_csv(all.covered) + "," +
         (all.widths.empty() ? std::string() : text_of(statistics(all.widths).mean)) + "," +
         csv_median(all.true_over_expected) + "," + part_csv(all.above_two) + "," +
         part_csv(all.above_three_unsaid) + "," + part_csv(all.missed) + "," +
         part_csv(all.of_nothing) + "\n";
}

/// The runs by a label, in the order in which they come.
std::vector<std::pair<std::string, std::vector<Figures>>> grouped(std::span<const Figures> runs,
                                                                  const std::string& label) {
  std::vector<std::pair<std::string, std::vector<Figures>>> groups;
  for (const Figures& run : runs) {
    const std::string& name = run.word(label);
    auto group = std::ranges::find(groups, name, [](const auto& one) { return one.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->second.push_back(run);
  }
  return groups;
}

/// How much of the true outline lies at each tenth of P(inside), and how much of each tenth is
/// tumour.
std::string print_tenths(std::span<const Figures> runs) {
  std::vector<double> outline(kBins, 0.0), area(kBins, 0.0), tumour(kBins, 0.0);
  int outlines = 0;
  for (const Figures& run : runs) {
    if (run.has("outline_by_p") && !run.word("outline_by_p").empty()) {
      const std::vector<double> parts = listed(run, "outline_by_p");
      for (std::size_t i = 0; i < kBins; ++i) outline[i] += parts[i];
      ++outlines;
    }
    if (!run.has("area_by_p") || run.word("area_by_p").empty()) continue;
    const std::vector<double> here = listed(run, "area_by_p"), stiff = listed(run, "tumour_by_p");
    for (std::size_t i = 0; i < kBins; ++i) {
      area[i] += here[i];
      tumour[i] += stiff[i];
    }
  }
  std::string csv = "from,to,true_outline,area_mm2,tumour\n";
  std::printf("\nP(inside)          true outline    of it tumour\n");
  for (std::size_t i = 0; i < kBins; ++i) {
    const double part = outlines > 0 ? outline[i] / outlines : 0.0;
    std::printf("%.1f to %.1f        %9.3f        %8s\n", 0.1 * static_cast<double>(i),
                0.1 * static_cast<double>(i + 1), part,
                area[i] > 0.0 ? fixed(tumour[i] / area[i], 3).c_str() : "-");
    csv += text_of(0.1 * static_cast<double>(i)) + "," + text_of(0.1 * static_cast<double>(i + 1)) +
           "," + text_of(part) + "," + text_of(area[i]) + "," +
           (area[i] > 0.0 ? text_of(tumour[i] / area[i]) : "") + "\n";
  }
  return csv;
}

std::string counted_columns(const std::string& name) {
  return name + "_of," + name + "," + name + "_low_95," + name + "_high_95";
}

}  // namespace

void report_worlds(const Results& results, const ReportFolder& folder) {
  std::vector<Figures> all;
  for (std::size_t cell = 0; cell < results.manifest.cells.size(); ++cell) {
    const std::vector<Figures> runs = results.of(cell);
    all.insert(all.end(), runs.begin(), runs.end());
  }
  std::printf(
      "\nWorlds that nothing was tuned to; %d of each family\n"
      "                  runs  error / bound   outline    band /  true / expected error    missed  "
      "  finds\n"
      "                          mean  median   in band   bound's   median  above 2  above 3 a "
      "tumour what is\n"
      "                                          (%2.0f %%)                               unsaid "
      "              not\n",
      results.trials(), 100.0 * std::stod(results.manifest.facts.at("band.probability")));
  std::string csv = "runs_of,runs,error_over_bound,error_over_bound_median," +
                    counted_columns("covered") + ",width_over_bound,true_over_expected," +
                    counted_columns("above_two") + "," + counted_columns("above_three_unsaid") +
                    "," + counted_columns("missed") + "," + counted_columns("false") + "\n";
  for (const char* label : {"family", "kind", "noise", "tissue", "on_the_way"}) {
    for (const auto& [name, runs] : grouped(all, label)) {
      const std::string prefix = std::string(label) == "noise"        ? "noise "
                                 : std::string(label) == "on_the_way" ? "on the way "
                                 : std::string(label) == "kind"       ? "all of "
                                                                      : "";
      csv += print_row(prefix + name, runs);
    }
    std::printf("\n");
  }
  csv += print_row("all", all);
  folder.write("coverage", csv);
  folder.write("coverage_tenths", print_tenths(all));
}

}  // namespace palpation::tool
