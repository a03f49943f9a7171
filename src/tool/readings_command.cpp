#include "tool/readings_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "palpation/base/contract.h"
#include "palpation/io/robot_log.h"
#include "palpation/probing/oscillation.h"
#include "palpation/probing/probings.h"
#include "palpation/probing/scan.h"
#include "scene/exit_code.h"
#include "scene/single_file.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

/// "role=NAME" texts as a map.
std::map<std::string, std::string> pairs_of(const std::vector<std::string>& texts,
                                            const std::string& option) {
  std::map<std::string, std::string> pairs;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw WrongUsage("readings: " + option + " takes ROLE=NAME, not '" + text + "'");
    if (!pairs.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
      throw WrongUsage("readings: " + option + " names '" + text.substr(0, equals) + "' twice");
  }
  return pairs;
}

LogFile read(const ReadingsArguments& arguments) {
  const LogRules rules{.columns = pairs_of(arguments.names.columns, "--column"),
                       .units = pairs_of(arguments.names.units, "--unit"),
                       .gain = arguments.names.gain,
                       .offset = arguments.names.offset,
                       .session = arguments.names.session};
  try {
    return read_robot_log(arguments.files.log, rules);
  } catch (const InvalidInput& error) {
    throw WrongUsage("readings: " + rule_words(error));
  }
}

/// What a log holds, where it is not said: names or depths make probings, raw counts a scan, an
/// oscillation a slide; else contact comes and goes, or nobody knows.
std::string kind_of(const LogFile& file, const ReadingsArguments& arguments) {
  if (arguments.kind != "auto") return arguments.kind;
  if (file.has_depth) return "probings";
  if (file.counts_only) return "scan";
  if (file.names_probings) return "probings";
  const bool oscillates = file.log.time_s.size() > 0 &&
                          (arguments.slide.frequency_hz || !oscillations_in(file.log).empty());
  if (oscillates) return "slide";
  if (!probings_in(file.log).empty()) return "probings";
  throw IoError(
      arguments.files.log.string() +
      ": neither probings (no column names them, and no force comes and goes), nor an "
      "oscillation" +
      (file.log.time_s.size() > 0 ? "" : " (a slide needs times, and no column has them)") +
      ": say --kind probings, slide or scan");
}

ContactOptions contact_of(const ReadingsArguments& arguments) {
  ContactOptions options{.least_samples = arguments.probing.least_samples};
  if (arguments.probing.approach == "yes") options.approach = Approach::Recorded;
  if (arguments.probing.approach == "no") options.approach = Approach::NotRecorded;
  if (arguments.probing.model == "hertz") {
    options.model = ContactModel::Hertz;
    if (!arguments.probing.radius_mm) throw WrongUsage("readings: --model hertz needs --radius-mm");
    options.indenter_radius_m = *arguments.probing.radius_mm * 1e-3;
  } else if (arguments.probing.model == "force") {
    options.model = ContactModel::ForceAtDepth;
    if (!arguments.probing.at_mm) throw WrongUsage("readings: --model force needs --at-mm");
    options.at_depth_m = *arguments.probing.at_mm * 1e-3;
  }
  return options;
}

void check_together(const ReadingsArguments& arguments, const std::string& kind) {
  const auto refuse = [&](const std::string& option, const std::string& of) {
    throw WrongUsage("readings: " + option + " is of " + of + ", and this log holds " +
                     (kind == "probings" ? "probings" : "a " + kind));
  };
  if (kind != "slide" && arguments.slide.frequency_hz) refuse("--frequency-hz", "a slide");
  if (kind != "slide" && arguments.slide.window_periods) refuse("--window-periods", "a slide");
  if (kind != "scan" && arguments.every_mm) refuse("--every-mm", "a scan");
  if (kind != "probings" && arguments.probing.model != "linear") refuse("--model", "probings");
  if (arguments.probing.model != "hertz" && arguments.probing.radius_mm)
    throw WrongUsage("readings: --radius-mm is of --model hertz");
  if (arguments.probing.model != "force" && arguments.probing.at_mm)
    throw WrongUsage("readings: --at-mm is of --model force");
}

ProbedLog read_as(const std::string& kind, const RobotLog& log,
                  const ReadingsArguments& arguments) {
  try {
    if (kind == "probings") return probing_readings(log, contact_of(arguments));
    if (kind == "scan")
      return scan_readings(log, {.every_m = arguments.every_mm.value_or(1) * 1e-3});
    return slide_readings(log, {.frequency_hz = arguments.slide.frequency_hz.value_or(0.0),
                                .window_periods = arguments.slide.window_periods.value_or(4),
                                .step_periods = arguments.slide.window_periods.value_or(4)});
  } catch (const BrokenContract& error) {
    const bool lacks_frequency = error.function() == "slide_readings" &&
                                 error.value() == "the log" && !arguments.slide.frequency_hz;
    throw IoError(arguments.files.log.string() + ": " + rule_words(error) +
                  (lacks_frequency ? ": --frequency-hz" : ""));
  }
}

/// A reason without its numbers, so that alike ones count together.
std::string kind_of_reason(const std::string& reason) {
  return reason.substr(0, reason.find_first_of("0123456789:"));
}

std::string left_out_words(const ProbedLog& result) {
  struct Count {
    int count = 0;
    const Probed* first = nullptr;
  };
  std::map<std::string, Count> counts;
  for (const Probed& probed : result.probed) {
    if (probed.reason.empty()) continue;
    Count& count = counts[kind_of_reason(probed.reason)];
    if (count.count++ == 0) count.first = &probed;
  }
  std::string words;
  for (const auto& [kind, count] : counts)
    words += "  " + std::to_string(count.count) + ": " + count.first->reason + " (" +
             (count.count > 1 ? "the first " : "") + "in line " +
             std::to_string(count.first->line) + ", \"" + count.first->probing + "\")\n";
  return words;
}

std::string missed_words(const ProbedLog& result) {
  const auto missed = std::count_if(result.probed.begin(), result.probed.end(),
                                    [](const Probed& probed) { return probed.is_missed; });
  if (missed == 0) return "";
  return "  " + std::to_string(missed) + (missed == 1 ? " of them is a row" : " of them are rows") +
         " of kind missed: the probe came and touched nothing, so palpate plan goes elsewhere.\n";
}

std::string result_words(const ProbedLog& result, std::size_t samples) {
  std::vector<double> readings, sds;
  int unknown = 0;
  for (const Probed& probed : result.probed) {
    if (!probed.reason.empty()) continue;
    readings.push_back(probed.reading);
    std::isnan(probed.noise_variance) ? void(++unknown)
                                      : sds.push_back(std::sqrt(probed.noise_variance));
  }
  std::sort(readings.begin(), readings.end());
  std::sort(sds.begin(), sds.end());
  std::string words = counted(readings.size(), "reading") + " from " + counted(samples, "sample") +
                      ": " + reading_text(readings.front()) + " to " +
                      reading_text(readings.back()) + " " + result.unit + ", " +
                      reading_text(readings[readings.size() / 2]) + " in the middle";
  words += sds.empty() ? ".\n"
                       : "; their noise is " + reading_text(sds[sds.size() / 2]) +
                             " (standard deviation of the middle one).\n";
  if (unknown > 0)
    words += std::to_string(unknown) +
             " of them do not tell their noise: noise_variance is left empty.\n";
  return words;
}

void write(const ReadingsArguments& arguments, const ProbedLog& result) {
  if (std::filesystem::weakly_canonical(arguments.files.out) ==
      std::filesystem::weakly_canonical(arguments.files.log))
    throw WrongUsage("readings: --out is the log itself, which stays as it is");
  const Existing existing = arguments.files.overwrite ? Existing::Replaced : Existing::Kept;
  if (!arguments.files.left_out.empty())
    write_single_file(arguments.files.left_out, left_out_csv(result), existing);
  write_single_file(arguments.files.out, probed_csv(result), existing);
}

}  // namespace

void readings(const ReadingsArguments& arguments) {
  const LogFile file = read(arguments);
  const std::string kind = kind_of(file, arguments);
  check_together(arguments, kind);
  const ProbedLog result = read_as(kind, file.log, arguments);
  const auto failed = static_cast<std::size_t>(
      std::count_if(result.probed.begin(), result.probed.end(),
                    [](const Probed& probed) { return !probed.reason.empty(); }));
  if (failed == result.probed.size())
    throw IoError(arguments.files.log.string() + ": no reading came of it" +
                  (failed > 0 ? ":\n" + left_out_words(result) : ""));
  write(arguments, result);
  if (arguments.quiet) return;
  std::string words;
  for (const std::string& remark : file.remarks) words += remark + "\n";
  words += "Taken as: " + std::string(kind == "probings" ? "probings" : "a " + kind) + ".\n";
  for (const std::string& remark : result.remarks) words += remark + "\n";
  words += result_words(result, static_cast<std::size_t>(file.log.size()));
  if (failed > 0)
    words += "No reading from " + std::to_string(failed) + ":\n" + left_out_words(result) +
             missed_words(result);
  words += "Next: palpate boundary SCENE.json --measurements " + arguments.files.out.string() +
           ", on a mesh of this tissue (of a flat one: palpate mesh plane --around " +
           arguments.files.out.string() + "; of a curved one: palpate mesh surface --points " +
           arguments.files.out.string() + "); \"reading_unit\": \"" + result.unit +
           "\" in the scene holds others to it.\n";
  std::fputs(words.c_str(), stdout);
}

}  // namespace palpation::tool
