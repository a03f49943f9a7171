/// readings: from a robot's log to readings with their noise.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palpation::tool {

struct ReadingsFiles {
  std::filesystem::path log, out;
  std::filesystem::path left_out;  ///< may be empty
  bool overwrite = false;          ///< other readings of these names
};

/// What the log's header leaves open.
struct LogNames {
  std::vector<std::string> columns, units;  ///< ROLE=NAME, QUANTITY=UNIT
  double gain = 0.0, offset = 0.0;          ///< newtons a count (0: none), counts at no force
  std::string session;
};

struct ProbingChoice {
  std::string model = "linear";            ///< linear, hertz or force
  std::optional<double> radius_mm, at_mm;  ///< of hertz, of force
  std::string approach = "auto";           ///< auto, yes or no
  int least_samples = 3;
};

struct SlideChoice {
  std::optional<double> frequency_hz;  ///< left out: found
  std::optional<int> window_periods;   ///< left out: 4
};

struct ReadingsArguments {
  ReadingsFiles files;
  std::string kind = "auto";  ///< auto, probings, slide or scan
  LogNames names;
  ProbingChoice probing;
  SlideChoice slide;
  std::optional<double> every_mm;  ///< of a scan; left out: 1
  bool quiet = false;
};

void readings(const ReadingsArguments& arguments);

}  // namespace palpation::tool
