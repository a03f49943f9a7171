#include "experiments/run_study.h"

#include <algorithm>
#include <mutex>
#include <set>

#include "experiments/in_cell.h"
#include "experiments/row_files.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "scene/digest.h"
#include "scene/exit_code.h"
#include "scene/progress.h"

namespace palpation::tool {
namespace {

/// The rows of the trials so far: in a folder, or in memory alone.
class Notebook {
 public:
  Notebook(const Manifest& manifest, const std::filesystem::path& folder, const Shard& shard,
           Existing results) {
    if (!folder.empty()) files_.emplace(folder, manifest, shard, results);
  }
  void add(const std::vector<Row>& trial) {
    if (files_)
      files_->add(trial);
    else
      rows_.insert(rows_.end(), trial.begin(), trial.end());
  }
  std::vector<Row> rows() const { return files_ ? files_->rows() : rows_; }
  void finish() {
    if (files_) files_->finish();
    std::ranges::sort(rows_, {}, &Row::key);
  }

 private:
  std::optional<RowFiles> files_;
  std::vector<Row> rows_;
};

std::vector<Row> rows_of(const Study& study, const RowKey& trial) {
  std::vector<Row> rows;
  const Cell& cell = study.cells[trial.cell];
  for (Figures& figures : in_cell(cell.name, [&] { return study.run(trial.cell, trial.seed); })) {
    for (const auto& [name, text] : cell.labels.texts()) figures.set(name, text);
    for (const auto& [name, text] : figures.texts())
      require(std::ranges::find(study.columns, name) != study.columns.end(), "experiment", name,
              "is no column of it");
    rows.push_back({{trial.cell, trial.seed, rows.size()}, std::move(figures)});
  }
  return rows;
}

/// Trials that measure the machine come first, one after the other.
std::vector<RowKey> missing_trials(const Study& study, const Manifest& manifest, const Shard& shard,
                                   const std::vector<Row>& rows) {
  const std::set<RowKey> done = trials_of(rows);
  std::vector<RowKey> missing = manifest.trials(shard);
  std::erase_if(missing, [&](const RowKey& trial) { return done.contains(trial); });
  std::ranges::stable_partition(missing,
                                [&](const RowKey& trial) { return study.cells[trial.cell].alone; });
  return missing;
}

std::string place_of(const Manifest& manifest, const RowKey& trial) {
  return "cell '" + manifest.cells[trial.cell].name + "', seed " + std::to_string(trial.seed);
}

}  // namespace

Manifest manifest_of(const Study& study, const ExperimentArguments& arguments) {
  Manifest manifest{.experiment = arguments.name,
                    .program = program_digest(),
                    .columns = study.columns,
                    .facts = study.facts,
                    .first_seed = arguments.first_seed};
  for (std::size_t i = 0; i < study.cells.size(); ++i) {
    const Cell& cell = study.cells[i];
    manifest.cells.push_back({cell.name, json_digest(cell.scene.complete()),
                              in_cell(cell.name, [&] { return study.mesh_digest(i); }),
                              cell.trials > 0 ? cell.trials : arguments.trials});
  }
  return manifest;
}

std::optional<Results> run_study(const Study& study, const ExperimentArguments& arguments,
                                 Existing results) {
  const Shard shard = arguments.shard.empty() ? Shard{} : shard_of(arguments.shard);
  const Manifest manifest = manifest_of(study, arguments);
  Notebook notebook(manifest, arguments.out, shard, results);
  const std::vector<RowKey> missing = missing_trials(study, manifest, shard, notebook.rows());
  const auto alone = static_cast<int>(std::ranges::count_if(
      missing, [&](const RowKey& trial) { return study.cells[trial.cell].alone; }));
  const int all = static_cast<int>(missing.size());
  Progress progress("Runs", all, arguments.quiet);
  std::mutex guard;
  int done = 0;
  const auto run = [&](int number) {
    const std::vector<Row> rows = rows_of(study, missing[static_cast<std::size_t>(number)]);
    const std::lock_guard lock(guard);
    notebook.add(rows);
    if (++done % std::max(1, all / 100) == 0 || done == all) progress.step(done, "");
  };
  for (int number = 0; number < alone; ++number) run(number);
  for_ranges(all - alone, 1, [&](int first, int last) {
    for (int number = first; number < last; ++number) run(alone + number);
  });
  notebook.finish();
  if (shard.of > 1) return std::nullopt;
  return Results{manifest, notebook.rows()};
}

Results merged(std::span<const std::filesystem::path> folders) {
  Results all;
  std::set<RowKey> seen;
  const std::filesystem::path* first = nullptr;
  for (const std::filesystem::path& folder : folders) {
    const auto [manifest, shard] = read_manifest(folder);
    if (!first) all.manifest = manifest;
    if (const std::string words = difference(all.manifest, manifest); !words.empty())
      throw IoError(folder.string() + ": is not of the same experiment as " +
                    (first ? first->string() : "") + ": " + words);
    if (!first) first = &folder;
    std::vector<Row> rows = read_rows(folder, manifest);
    for (const RowKey& trial : trials_of(rows)) {
      if (!seen.insert(trial).second)
        throw IoError(folder.string() + ": " + place_of(manifest, trial) +
                      " is doubled: another folder has it, too");
    }
    std::ranges::move(rows, std::back_inserter(all.rows));
  }
  std::string missing;
  std::size_t count = 0;
  for (const RowKey& trial : all.manifest.trials()) {
    if (seen.contains(trial)) continue;
    if (++count == 1) missing = place_of(all.manifest, trial);
  }
  if (count > 0)
    throw IoError("merge: " + std::to_string(count) + " of " +
                  std::to_string(all.manifest.trials().size()) +
                  " trials are missing, the first of them " + missing);
  std::ranges::sort(all.rows, {}, &Row::key);
  return all;
}

}  // namespace palpation::tool
