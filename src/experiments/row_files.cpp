#include "experiments/row_files.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRowsFile = "rows.csv";
constexpr const char* kTimesFile = "times.csv";
/// What stands before the figures, in rows.csv and in times.csv.
const std::vector<std::string> kMarks = {"cell", "seed",  "part", "parts",
                                         "name", "scene", "mesh", "program"};
constexpr std::size_t kCell = 0, kSeed = 1, kPart = 2, kParts = 3, kName = 4;
constexpr std::size_t kTimeMarks = 3;

/// Of rows.csv, or of times.csv: the marks and the figures that stand there.
std::vector<std::string> columns_of(const Manifest& manifest, bool of_the_machine) {
  std::vector<std::string> columns = kMarks;
  if (of_the_machine) columns.resize(kTimeMarks);
  for (const std::string& column : manifest.columns) {
    require(std::ranges::find(kMarks, column) == kMarks.end(), "rows", column,
            "is the name of a mark: no figure can have it");
    if (is_of_the_machine(column) == of_the_machine) columns.push_back(column);
  }
  return columns;
}

std::string line_of(const Manifest& manifest, const Row& row, std::size_t parts,
                    bool of_the_machine) {
  const CellMark& cell = manifest.cells[row.key.cell];
  std::vector<std::string> texts = {std::to_string(row.key.cell), std::to_string(row.key.seed),
                                    std::to_string(row.key.part)};
  if (!of_the_machine)
    texts.insert(texts.end(),
                 {std::to_string(parts), cell.name, cell.scene, cell.mesh, manifest.program});
  for (const std::string& column : manifest.columns) {
    if (is_of_the_machine(column) == of_the_machine) texts.push_back(row.figures.word(column));
  }
  return csv_line(texts);
}

/// How many rows the trial of each has.
std::map<RowKey, std::size_t> parts_of(std::span<const Row> rows) {
  std::map<RowKey, std::size_t> parts;
  for (const Row& row : rows) ++parts[{row.key.cell, row.key.seed}];
  return parts;
}

std::string text_of_rows(const Manifest& manifest, std::span<const Row> rows, bool of_the_machine) {
  std::string text = csv_line(columns_of(manifest, of_the_machine));
  const auto parts = parts_of(rows);
  for (const Row& row : rows)
    text += line_of(manifest, row, parts.at({row.key.cell, row.key.seed}), of_the_machine);
  return text;
}

std::uint64_t count_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string_view text = table.cell(row, column);
  std::uint64_t count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status != std::errc{} || end != text.data() + text.size())
    fail_at_cell(table, row, column, "must be a whole number");
  return count;
}

/// The key of a row that is this experiment's.
RowKey checked_key(const CsvTable& table, std::size_t row, const Manifest& manifest) {
  const RowKey key{count_at(table, row, kCell), count_at(table, row, kSeed),
                   count_at(table, row, kPart)};
  if (key.cell >= manifest.cells.size()) fail_at_cell(table, row, kCell, "is no cell of these");
  const CellMark& cell = manifest.cells[key.cell];
  if (key.seed < manifest.first_seed ||
      key.seed - manifest.first_seed >= static_cast<std::uint64_t>(cell.trials))
    fail_at_cell(table, row, kSeed, "is no seed of these trials");
  const std::string* expected[] = {&cell.name, &cell.scene, &cell.mesh, &manifest.program};
  for (std::size_t mark = 0; mark < std::size(expected); ++mark) {
    if (table.cell(row, kName + mark) != *expected[mark])
      fail_at_cell(table, row, kName + mark,
                   "is foreign: this experiment's is '" + *expected[mark] + "'");
  }
  return key;
}

void check_columns(const CsvTable& table, const std::vector<std::string>& expected) {
  if (table.columns() != expected)
    throw IoError(table.name() + ":" + std::to_string(table.header_line()) +
                  ": the columns are not those of this experiment");
}

void add_figures(const CsvTable& table, std::size_t row, std::size_t first, Figures& figures) {
  for (std::size_t column = first; column < table.columns().size(); ++column)
    figures.set(table.columns()[column], std::string(table.cell(row, column)));
}

void sort(std::vector<Row>& rows) { std::ranges::sort(rows, {}, &Row::key); }

/// The figures of times.csv, to rows that are there; what belongs to none is of a trial that was
/// cut off.
void add_times(std::vector<Row>& rows, const std::string& text, const std::string& name,
               const Manifest& manifest) {
  if (text.empty()) return;
  const CsvTable table = parse_csv(text, name);
  check_columns(table, columns_of(manifest, true));
  std::map<RowKey, Row*> by_key;
  for (Row& row : rows) by_key[row.key] = &row;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const auto found = by_key.find(
        {count_at(table, row, kCell), count_at(table, row, kSeed), count_at(table, row, kPart)});
    if (found != by_key.end()) add_figures(table, row, kTimeMarks, found->second->figures);
  }
}

/// What a folder holds that is not these trials, in words; empty if nothing.
std::string others_in(const fs::path& folder, const Manifest& manifest, const Shard& shard) {
  if (!fs::exists(folder / kManifestFile)) {
    return fs::exists(folder / kRowsFile) ? std::string(kRowsFile) + " without " + kManifestFile
                                          : "";
  }
  const auto [there, its_shard] = read_manifest(folder);
  return its_shard == shard ? difference(there, manifest) : "shards";
}

/// Nothing may be written into a folder that holds another experiment, unless that is asked for.
fs::path prepared(const fs::path& folder, const Manifest& manifest, const Shard& shard,
                  Existing results) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const std::string others = others_in(folder, manifest, shard);
  if (!others.empty() && results == Existing::Kept)
    throw IoError(folder.string() + ": holds rows of another experiment (" + others +
                  "): give another folder, or --overwrite");
  if (!others.empty()) {
    for (const char* file : {kRowsFile, kTimesFile}) fs::remove(folder / file, ignored);
  }
  write_atomically(folder / kManifestFile, to_json(manifest, shard).dump(2) + "\n");
  return folder;
}

}  // namespace

std::vector<Row> parse_rows(const std::string& text, const std::string& name,
                            const Manifest& manifest) {
  if (text.empty()) return {};
  const CsvTable table = parse_csv(text, name);
  check_columns(table, columns_of(manifest, false));
  std::map<RowKey, std::vector<Row>> trials;
  std::map<RowKey, std::size_t> wanted;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    Row row{.key = checked_key(table, i, manifest)};
    add_figures(table, i, kMarks.size(), row.figures);
    const RowKey trial{row.key.cell, row.key.seed};
    wanted[trial] = count_at(table, i, kParts);
    if (row.key.part >= wanted[trial])
      fail_at_cell(table, i, kPart, "must be below the number of parts");
    if (std::ranges::find(trials[trial], row.key, &Row::key) != trials[trial].end())
      fail_at_row(table, i,
                  "this row is doubled: cell " + std::to_string(row.key.cell) + ", seed " +
                      std::to_string(row.key.seed));
    trials[trial].push_back(std::move(row));
  }
  std::vector<Row> rows;
  for (auto& [trial, parts] : trials) {
    if (parts.size() == wanted[trial]) std::ranges::move(parts, std::back_inserter(rows));
  }
  sort(rows);
  return rows;
}

std::vector<Row> read_rows(const fs::path& folder, const Manifest& manifest) {
  const fs::path path = folder / kRowsFile, times = folder / kTimesFile;
  std::vector<Row> rows = parse_rows(read_file(path), path.string(), manifest);
  if (fs::exists(times)) add_times(rows, read_file(times), times.string(), manifest);
  return rows;
}

std::string rows_text(const Manifest& manifest, std::span<const Row> rows) {
  return text_of_rows(manifest, rows, false);
}

std::string times_text(const Manifest& manifest, std::span<const Row> rows) {
  return text_of_rows(manifest, rows, true);
}

std::set<RowKey> trials_of(std::span<const Row> rows) {
  std::set<RowKey> trials;
  for (const Row& row : rows) trials.insert({row.key.cell, row.key.seed});
  return trials;
}

RowFiles::RowFiles(const fs::path& folder, Manifest manifest, Shard shard, Existing results)
    : manifest_(std::move(manifest)),
      rows_file_(prepared(folder, manifest_, shard, results) / kRowsFile) {
  rows_ = parse_rows(rows_file_.content(), rows_file_.path().string(), manifest_);
  if (std::ranges::any_of(manifest_.columns, is_of_the_machine)) {
    times_file_.emplace(folder / kTimesFile);
    add_times(rows_, times_file_->content(), times_file_->path().string(), manifest_);
  }
  // The rows of a trial that was cut off go, so that it can be made again.
  finish();
}

void RowFiles::add(std::span<const Row> trial) {
  std::string rows, times;
  for (const Row& row : trial) {
    times += line_of(manifest_, row, trial.size(), true);
    rows += line_of(manifest_, row, trial.size(), false);
  }
  if (times_file_) times_file_->append(times);  // first: a trial is done once its rows are there
  rows_file_.append(rows);
  rows_.insert(rows_.end(), trial.begin(), trial.end());
}

void RowFiles::replace(std::span<const Row> rows) {
  rows_.assign(rows.begin(), rows.end());
  finish();
}

void RowFiles::finish() {
  sort(rows_);
  if (times_file_) times_file_->replace(times_text(manifest_, rows_));
  rows_file_.replace(rows_text(manifest_, rows_));
}

}  // namespace palpation::tool
