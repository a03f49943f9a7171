/// session: a real run, step by step, that loses nothing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

/// Which scene, and which folder.
struct SessionPlace {
  std::filesystem::path scene, folder;
  std::vector<std::string> overrides;
  bool anyway = false;  ///< go on though what changed changes the plan
};

/// What a person or a robot says.
struct SessionWords {
  std::filesystem::path readings;  ///< to record
  std::vector<int> numbers;        ///< of stops or readings; empty, of stops: all that are open
  std::vector<double> place_mm{};  ///< three
  double radius_mm = 0.0;
  std::string why;
};

struct SessionExport {
  std::filesystem::path folder;
  std::optional<int> plan;  ///< as it was before this plan
  bool overwrite = false;   ///< other files of these names
};

void session_show(const SessionPlace& place);
void session_next(const SessionPlace& place);
void session_record(const SessionPlace& place, const SessionWords& words);
void session_skip(const SessionPlace& place, const SessionWords& words);
void session_withdraw(const SessionPlace& place, const SessionWords& words);
void session_touch(const SessionPlace& place, const SessionWords& words);
void session_keep_out(const SessionPlace& place, const SessionWords& words);
void session_export(const SessionPlace& place, const SessionExport& where);

}  // namespace palpation::tool
