/// An experiment: cells, what one trial of a cell gives, and what is said of all rows.
///
/// A report is made from rows alone, so that it is the same whether they were made in one piece, in
/// shards on other machines, or yesterday.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/manifest.h"
#include "experiments/row.h"
#include "scene/scene.h"

namespace palpation::tool {

/// A scene that is run once per trial, each time with another seed.
struct Cell {
  std::string name;
  Scene scene;
  Figures labels{};    ///< stand in each of its rows
  int trials = 0;      ///< 0: as many as are asked for
  bool alone = false;  ///< while nothing else runs: it measures the machine
};

struct Study {
  std::vector<Cell> cells{};
  std::vector<std::string> columns{};  ///< of all labels, and all figures that a trial sets
  std::map<std::string, std::string> facts{};
  std::vector<Cell> printed{};  ///< what --print-scene prints; empty: the cells
  int trials = 0;               ///< by default; 0: the experiment's
  std::function<std::string(std::size_t cell)> mesh_digest{};
  /// The rows of one trial; called from several threads.
  std::function<std::vector<Figures>(std::size_t cell, std::uint64_t seed)> run{};
};

/// All rows, in order.
struct Results {
  Manifest manifest{};
  std::vector<Row> rows{};

  int trials() const { return manifest.cells.empty() ? 0 : manifest.cells.front().trials; }
  std::vector<Figures> of(std::size_t cell) const;  ///< the rows of a cell
};

/// The values of a figure over rows that have it.
std::vector<double> values_of(std::span<const Figures> rows, const std::string& name);

/// Where a report puts its tables and pictures.
struct ReportFolder {
  std::filesystem::path folder{};                                     ///< empty: nowhere
  void write(const std::string& name, const std::string& csv) const;  ///< name.csv
  /// name.png from name.csv, by palpate-draw with these options; says why not.
  void draw(const std::string& name, const std::vector<std::string>& options) const;
};

}  // namespace palpation::tool
