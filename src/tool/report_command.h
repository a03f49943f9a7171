/// palpate report: a run in one page.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace palpation::tool {

struct ReportArguments {
  std::filesystem::path run;
  std::filesystem::path out;  ///< a file; empty: report.html in the run's folder
  bool overwrite = false;     ///< a page that is none of the run's
};

void report_run(const ReportArguments& arguments);

void add_report_command(CLI::App& app);

}  // namespace palpation::tool
