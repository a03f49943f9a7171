/// The rows of an experiment in a folder: rows.csv, and times.csv beside it for what is the
/// machine's.
///
/// Rows come in any order, a trial at once, and are on the disk before the trial counts as done.
/// Who opens the folder again after any death goes on with what is missing. Once all is there the
/// rows lie in order: same scene, same seeds, same bytes of rows.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiments/manifest.h"
#include "experiments/row.h"
#include "io/append_file.h"
#include "scene/single_file.h"

namespace palpation::tool {

/// The rows of a text as rows.csv has it. Throws IoError naming the line of a row that is doubled
/// or not of this experiment. The rows of a trial that are not all there are left out.
std::vector<Row> parse_rows(const std::string& text, const std::string& name,
                            const Manifest& manifest);
/// The same of a folder, with the figures of times.csv.
std::vector<Row> read_rows(const std::filesystem::path& folder, const Manifest& manifest);

/// rows.csv, or times.csv, whole: the header and all rows, in order.
std::string rows_text(const Manifest& manifest, std::span<const Row> rows);
std::string times_text(const Manifest& manifest, std::span<const Row> rows);

/// Trials whose rows are there, sorted.
std::set<RowKey> trials_of(std::span<const Row> rows);

class RowFiles {
 public:
  /// Opens a folder to write to, makes it, or goes on where it holds the same experiment. Throws
  /// IoError where it holds another one that is to be kept, or another process writes to it;
  /// WriteError.
  RowFiles(const std::filesystem::path& folder, Manifest manifest, Shard shard,
           Existing results = Existing::Kept);

  const std::vector<Row>& rows() const { return rows_; }
  /// The rows of one trial, all of them.
  void add(std::span<const Row> trial);
  /// Rows of many trials, in order, in place of what is there.
  void replace(std::span<const Row> rows);
  /// Puts the files in order; rows() too.
  void finish();

 private:
  Manifest manifest_;
  AppendFile rows_file_;
  std::optional<AppendFile> times_file_;  ///< nothing where no figure is the machine's
  std::vector<Row> rows_;
};

}  // namespace palpation::tool
