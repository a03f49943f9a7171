/// Which trials an experiment consists of, and of what: rows are added up only where this is equal.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/row.h"

namespace palpation::tool {

/// Some of an experiment's trials: every `of`-th, from the `number`-th on, counted from 1.
struct Shard {
  int number = 1;
  int of = 1;
  bool operator==(const Shard&) const = default;
};

/// "3/8". Throws WrongUsage for anything else.
Shard shard_of(const std::string& text);

/// A cell, as rows name it.
struct CellMark {
  std::string name;
  std::string scene;  ///< digests
  std::string mesh;
  int trials = 1;
  bool operator==(const CellMark&) const = default;
};

struct Manifest {
  std::string experiment{};
  std::string program{};  ///< version and digest
  std::vector<CellMark> cells{};
  std::vector<std::string> columns{};          ///< of the figures, in order
  std::map<std::string, std::string> facts{};  ///< what the report says beside the rows
  std::uint64_t first_seed = 0;

  /// Of all trials, cell by cell; part is 0.
  std::vector<RowKey> trials() const;
  /// Those of a shard.
  std::vector<RowKey> trials(const Shard& shard) const;
};

nlohmann::json to_json(const Manifest& manifest, const Shard& shard);
/// Reads experiment.json of a folder. Throws IoError.
std::pair<Manifest, Shard> read_manifest(const std::filesystem::path& folder);

/// What differs, in words, or empty: "trials of cell 'noise 5 %': 10 and 20".
std::string difference(const Manifest& a, const Manifest& b);

inline constexpr const char* kManifestFile = "experiment.json";

}  // namespace palpation::tool
