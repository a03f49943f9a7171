/// palpate export: a run for other programs.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace palpation::tool {

struct ExportArguments {
  std::filesystem::path run;
  std::string program;        ///< slicer, paraview or csv
  std::string frame;          ///< RAS or LPS; empty: as the run says
  std::filesystem::path out;  ///< empty: a folder of the program's name in the run's
  bool overwrite = false;     ///< files that are none of an export's
};

void export_run(const ExportArguments& arguments);

void add_export_command(CLI::App& app);

}  // namespace palpation::tool
