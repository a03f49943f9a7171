#include "experiments/manifest.h"

#include <charconv>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/exit_code.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

std::string differing(const std::string& what, const std::string& a, const std::string& b) {
  return a == b ? "" : what + ": " + a + " and " + b;
}

std::string difference(const CellMark& a, const CellMark& b) {
  for (const std::string& words : {differing("cells", "'" + a.name + "'", "'" + b.name + "'"),
                                   differing("scene of cell '" + a.name + "'", a.scene, b.scene),
                                   differing("mesh of cell '" + a.name + "'", a.mesh, b.mesh),
                                   differing("trials of cell '" + a.name + "'",
                                             std::to_string(a.trials), std::to_string(b.trials))}) {
    if (!words.empty()) return words;
  }
  return "";
}

Manifest manifest_of(const json& told) {
  Manifest manifest;
  told.at("experiment").get_to(manifest.experiment);
  told.at("program").get_to(manifest.program);
  told.at("columns").get_to(manifest.columns);
  told.at("facts").get_to(manifest.facts);
  told.at("first_seed").get_to(manifest.first_seed);
  for (const json& cell : told.at("cells"))
    manifest.cells.push_back(
        {cell.at("name"), cell.at("scene"), cell.at("mesh"), cell.at("trials")});
  return manifest;
}

}  // namespace

Shard shard_of(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = number.ptr != end && *number.ptr == '/';
  const auto of = has_slash ? std::from_chars(number.ptr + 1, end, shard.of) : number;
  const bool is_read =
      has_slash && number.ec == std::errc{} && of.ec == std::errc{} && of.ptr == end;
  if (!is_read || shard.of < 1 || shard.number < 1 || shard.number > shard.of)
    throw WrongUsage("--shard: is '" + text + "', but must be I/N with 1 <= I <= N, such as 3/8");
  return shard;
}

std::vector<RowKey> Manifest::trials() const { return trials(Shard{}); }

std::vector<RowKey> Manifest::trials(const Shard& shard) const {
  std::vector<RowKey> keys;
  int count = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (int trial = 0; trial < cells[cell].trials; ++trial) {
      if (count++ % shard.of == shard.number - 1)
        keys.push_back({cell, first_seed + static_cast<std::uint64_t>(trial)});
    }
  }
  return keys;
}

json to_json(const Manifest& manifest, const Shard& shard) {
  json cells = json::array();
  for (const CellMark& cell : manifest.cells)
    cells.push_back(
        {{"name", cell.name}, {"scene", cell.scene}, {"mesh", cell.mesh}, {"trials", cell.trials}});
  return {{"experiment", manifest.experiment}, {"program", manifest.program},
          {"cells", std::move(cells)},         {"columns", manifest.columns},
          {"facts", manifest.facts},           {"first_seed", manifest.first_seed},
          {"shard", {shard.number, shard.of}}};
}

std::pair<Manifest, Shard> read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kManifestFile;
  const std::string text = read_file(path);
  try {
    const json told = json::parse(text);
    const json& shard = told.at("shard");
    return {manifest_of(told), {shard.at(0), shard.at(1)}};
  } catch (const json::exception& error) {
    throw IoError(path.string() + ": is no experiment's: " + error.what());
  }
}

std::string difference(const Manifest& a, const Manifest& b) {
  for (const std::string& words :
       {differing("experiments", a.experiment, b.experiment),
        differing("programs", a.program, b.program),
        differing("first seeds", std::to_string(a.first_seed), std::to_string(b.first_seed)),
        differing("numbers of cells", std::to_string(a.cells.size()),
                  std::to_string(b.cells.size()))}) {
    if (!words.empty()) return words;
  }
  for (std::size_t cell = 0; cell < a.cells.size(); ++cell) {
    if (const std::string words = difference(a.cells[cell], b.cells[cell]); !words.empty())
      return words;
  }
  if (a.columns != b.columns) return "columns";
  return a.facts != b.facts ? "facts" : "";
}

}  // namespace palpation::tool
