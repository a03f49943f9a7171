/// run.json: whose run a folder holds, how far it came, and which files are its own, told by their
/// bytes: a file that was changed since is a person's.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace palpation::tool {

/// Fingerprints by name, such as "steps/step_007.vtp".
using Fingerprints = std::map<std::string, std::string>;

/// "in progress" or "landing" of a run that no longer writes: it died.
struct RunRecord {
  std::string command;
  std::string question;  ///< what was asked, as a fingerprint: equal for the same run again
  std::string state;     ///< in progress, landing, complete, interrupted, failed
  Fingerprints files{};
  Fingerprints replaces{};  ///< of an earlier run, as long as they may still be there
  nlohmann::json begun{};   ///< what the summary will say and was known before; null once it does

  bool owns(const std::string& name, const std::string& fingerprint) const;
};

/// Nothing where there is none, or one that no palpate wrote.
std::optional<RunRecord> read_run_record(const std::filesystem::path& folder);
std::string document(const RunRecord& record);

/// 16 hexadecimal digits (FNV-1a).
std::string fingerprint_of_text(const std::string& text);
/// Of a file's bytes; of timings.json, those that are no numbers. Nothing unless it is a regular
/// file that can be read.
std::optional<std::string> fingerprint_of_file(const std::filesystem::path& path);

}  // namespace palpation::tool
