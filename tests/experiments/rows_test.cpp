// Rows of trials: what is there once is there for good, and what does not belong together is not
// added up.
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/row_files.h"
#include "experiments/run_study.h"
#include "io/temporary_folder.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/exit_code.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

/// Two cells of two trials; each has an error and a time.
Manifest two_cells() {
  return {.experiment = "coverage",
          .program = "p",
          .cells = {{"noise 1 %", "s1", "m", 2}, {"noise 5 %", "s5", "m", 2}},
          .columns = {"error_mm2", "batch_s"},
          .first_seed = 7};
}

Row row_of(std::size_t cell, std::uint64_t seed, double error) {
  return {{cell, seed}, Figures().set("error_mm2", error).set("batch_s", 0.25)};
}

std::vector<Row> all_rows() {
  return {row_of(0, 7, 1.5), row_of(0, 8, 2.5), row_of(1, 7, 3.5), row_of(1, 8, 4.5)};
}

void write_shard(const fs::path& folder, const Shard& shard, std::span<const Row> rows) {
  RowFiles files(folder, two_cells(), shard);
  for (const Row& row : rows) files.add({&row, 1});
}

std::string words_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expect_in(const std::string& part, const std::string& words) {
  EXPECT_NE(words.find(part), std::string::npos) << words;
}

TEST(RowFiles, InAnyOrderGiveTheSameBytes) {
  const TemporaryFolder folder;
  std::vector<Row> rows = all_rows();
  write_shard(folder.path() / "a", {}, rows);
  std::reverse(rows.begin(), rows.end());
  RowFiles reversed(folder.path() / "b", two_cells(), {});
  for (const Row& row : rows) reversed.add({&row, 1});
  reversed.finish();
  RowFiles(folder.path() / "a", two_cells(), {}).finish();
  for (const char* file : {"rows.csv", "times.csv", "experiment.json"})
    EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file));
}

TEST(RowFiles, RefuseAFigureThatIsCalledAsAMark) {
  const TemporaryFolder folder;
  Manifest manifest = two_cells();
  manifest.columns.push_back("name");
  expect_in("name is the name of a mark",
            words_of([&] { RowFiles(folder.path() / "a", manifest, {}); }));
}

TEST(RowFiles, KeepATrialOnceItIsThere) {
  const TemporaryFolder folder;
  write_shard(folder.path(), {}, std::vector{all_rows()[2]});
  const RowFiles again(folder.path(), two_cells(), {});
  ASSERT_EQ(again.rows().size(), 1u);
  EXPECT_EQ(again.rows()[0].key, (RowKey{1, 7}));
  EXPECT_EQ(again.rows()[0].figures.number("error_mm2"), 3.5);
  EXPECT_EQ(again.rows()[0].figures.number("batch_s"), 0.25);
}

TEST(RowFiles, ForgetATornLineAndKeepWhatIsBeforeIt) {
  const TemporaryFolder folder;
  write_shard(folder.path(), {}, std::vector{all_rows()[0], all_rows()[1]});
  const std::string whole = read_file(folder.path() / "rows.csv");
  for (std::size_t cut = 1; cut < 12; ++cut) {
    std::ofstream(folder.path() / "rows.csv", std::ios::binary)
        << whole.substr(0, whole.size() - cut);
    EXPECT_EQ(RowFiles(folder.path(), two_cells(), {}).rows().size(), 1u) << cut;
  }
}

TEST(RowFiles, ForgetATrialWhoseRowsAreNotAllThere) {
  const TemporaryFolder folder;
  const std::vector<Row> trial = {{{0, 7, 0}, Figures().set("error_mm2", 1.0)},
                                  {{0, 7, 1}, Figures().set("error_mm2", 2.0)}};
  { RowFiles(folder.path(), two_cells(), {}).add(trial); }
  EXPECT_EQ(RowFiles(folder.path(), two_cells(), {}).rows().size(), 2u);
  const std::string whole = read_file(folder.path() / "rows.csv");
  const std::size_t last = whole.rfind('\n', whole.size() - 2);
  std::ofstream(folder.path() / "rows.csv", std::ios::binary) << whole.substr(0, last + 1);
  EXPECT_TRUE(RowFiles(folder.path(), two_cells(), {}).rows().empty());
}

TEST(RowFiles, RefuseAFolderOfAnotherExperiment) {
  const TemporaryFolder folder;
  write_shard(folder.path(), {}, all_rows());
  Manifest other = two_cells();
  other.cells[1].scene = "s6";
  expect_in("scene of cell 'noise 5 %': s5 and s6",
            words_of([&] { RowFiles(folder.path(), other, {}); }));
  expect_in("(shards)", words_of([&] { RowFiles(folder.path(), two_cells(), {1, 2}); }));
}

TEST(RowFiles, HaveOneWriter) {
  const TemporaryFolder folder;
  const RowFiles first(folder.path(), two_cells(), {});
  expect_in("another process is writing to it",
            words_of([&] { RowFiles(folder.path(), two_cells(), {}); }));
}

TEST(Rows, AreRefusedByLineWhereTheyAreDoubledOrForeign) {
  const std::string header = "cell,seed,part,parts,name,scene,mesh,program,error_mm2\n";
  const std::string good = "0,7,0,1,noise 1 %,s1,m,p,1.5\n";
  const auto refusal = [&](const std::string& rows) {
    return words_of([&] { parse_rows(header + rows, "rows.csv", two_cells()); });
  };
  EXPECT_EQ(parse_rows(header + good, "rows.csv", two_cells()).size(), 1u);
  expect_in("rows.csv:3: ", refusal(good + good));
  expect_in("doubled: cell 0, seed 7", refusal(good + good));
  expect_in("is foreign: this experiment's is 's1'", refusal("0,7,0,1,noise 1 %,s2,m,p,1\n"));
  expect_in("is foreign: this experiment's is 'p'", refusal("0,7,0,1,noise 1 %,s1,m,q,1\n"));
  expect_in("is no seed of these trials", refusal("0,9,0,1,noise 1 %,s1,m,p,1\n"));
  expect_in("is no cell of these", refusal("2,7,0,1,noise 1 %,s1,m,p,1\n"));
}

TEST(Shards, PartTheTrialsAmongThem) {
  std::vector<RowKey> all;
  for (int number = 1; number <= 3; ++number) {
    for (const RowKey& trial : two_cells().trials({number, 3})) all.push_back(trial);
  }
  std::ranges::sort(all);
  EXPECT_EQ(all, two_cells().trials());
}

TEST(Shards, AreNumberedFromOne) {
  EXPECT_EQ(shard_of("3/8"), (Shard{3, 8}));
  for (const char* bad : {"", "0/8", "9/8", "3", "3/", "/8", "3/8/1", "-1/8", "a/b", "3/0", " 3/8"})
    EXPECT_THROW(shard_of(bad), WrongUsage) << bad;
}

TEST(Merging, GivesTheRowsOfTheWhole) {
  const TemporaryFolder folder;
  const std::vector<Row> rows = all_rows();
  write_shard(folder.path() / "1", {1, 2}, std::vector{rows[0], rows[2]});
  write_shard(folder.path() / "2", {2, 2}, std::vector{rows[1], rows[3]});
  const Results results = merged(std::vector{folder.path() / "2", folder.path() / "1"});
  EXPECT_EQ(rows_text(results.manifest, results.rows), rows_text(two_cells(), rows));
}

TEST(Merging, RefusesByNameWhatIsMissingDoubledOrForeign) {
  const TemporaryFolder folder;
  const std::vector<Row> rows = all_rows();
  write_shard(folder.path() / "1", {1, 2}, std::vector{rows[0], rows[2]});
  write_shard(folder.path() / "2", {2, 2}, std::vector{rows[1]});
  expect_in("1 of 4 trials are missing, the first of them cell 'noise 5 %', seed 8", words_of([&] {
              merged(std::vector{folder.path() / "1", folder.path() / "2"});
            }));
  expect_in("cell 'noise 1 %', seed 7 is doubled", words_of([&] {
              merged(std::vector{folder.path() / "1", folder.path() / "1"});
            }));
  Manifest other = two_cells();
  other.program = "q";
  { RowFiles files(folder.path() / "3", other, {2, 2}); }
  expect_in("programs: p and q", words_of([&] {
              merged(std::vector{folder.path() / "1", folder.path() / "3"});
            }));
}

}  // namespace
}  // namespace palpation::tool
