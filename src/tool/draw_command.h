/// palpate draw: figures for papers, of one run or of several side by side.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace palpation::tool {

/// How a figure is to look.
struct FigureArguments {
  std::string format;               ///< png, svg or pdf; empty: as the file's name ends
  std::vector<std::string> panels;  ///< of mean, stddev and boundary; empty: all
  double width_mm = 180.0;
  double dots_per_inch = 300.0;
  std::vector<double> limits, stddev_limits;  ///< two each, or none
};

void draw_runs(const std::vector<std::filesystem::path>& runs, const std::filesystem::path& out,
               bool overwrite, const FigureArguments& figure);

void add_draw_command(CLI::App& app);

}  // namespace palpation::tool
