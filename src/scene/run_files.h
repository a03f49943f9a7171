/// The names that a run may write into its folder.
#pragma once

#include <array>
#include <string_view>

namespace palpation::tool {

inline constexpr const char* kRecordName = "run.json";
inline constexpr const char* kSummaryName = "summary.json";
inline constexpr const char* kMeasurementsName = "measurements.csv";
inline constexpr const char* kReadingsUsedName = "readings_used.csv";
inline constexpr const char* kReportName = "report.html";
inline constexpr const char* kTimingsName = "timings.json";
inline constexpr const char* kStepsName = "steps";
inline constexpr const char* kStepsListName = "steps.pvd";

/// In the order in which they land: without the last one a folder is not finished.
inline constexpr std::array kRunFiles = {
    "waypoints.csv",   "path.csv",     kMeasurementsName, kReadingsUsedName, "trace.csv",
    "boundary.wkt",    "boundary.vtp", "surface.vtp",     kStepsListName,    "picture.png",
    "convergence.png", kReportName,    kTimingsName,      kSummaryName};

/// "step_007.vtp"
bool is_step(std::string_view name);

/// One of the above, or "steps/step_007.vtp".
bool is_run_file(std::string_view name);

/// A name under which a file is written before it gets its own.
bool is_partial(std::string_view name);

}  // namespace palpation::tool
