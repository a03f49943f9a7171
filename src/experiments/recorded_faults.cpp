// R4: what is known to be wrong with the recordings, and what the screen sets aside.
#include <functional>

#include "experiments/recorded.h"
#include "palpation/readings/screening.h"

namespace palpation::tool {
namespace {

constexpr double kFaultyShare = 0.1;  // of a row's readings: the row has a fault

bool is_fault(const Palpation& palpation) {
  return !palpation.set_aside.empty() && palpation.set_aside != kStartUp;
}

/// What is known to be wrong with a recording: readings by their row, index and place along the
/// row.
struct KnownFault {
  std::string recording;
  std::function<bool(int row, int index, double y_m)> is_faulty;
};

}  // namespace

void add_faults(const ExperimentArguments& arguments, std::vector<Figure>& figures) {
  const std::vector<KnownFault> faults = {
      {"exp2", [](int row, int, double) { return row >= 3; }},
      {"exp3", [](int row, int, double y_m) { return row == 9 || (row == 0 && y_m < 0.005); }},
      {"exp5", [](int row, int, double y_m) { return row == 2 && y_m > 0.037; }},
      {"exp6", [](int row, int, double y_m) { return row == 0 || (row == 1 && y_m < 0.022); }},
      {"probe_data_L2R_old_tool_tilt_yaw90",
       [](int row, int, double y_m) { return row == 0 && y_m < 0.0235; }},
      {"point_probe_40x20x1",
       [](int, int index, double) { return index >= 667; }},  // the first of equal readings is none
      {"dense_grid",
       [](int, int index, double) {
         return index == 129 || index == 130 || index == 131 || index == 214;
       }},
  };
  for (const KnownFault& fault : faults) {
    const Recorded recording = recorded(arguments, fault.recording);
    const std::vector<Palpation> result = screened(recording.tissue, recording.palpations);
    int missed = 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i].set_aside.empty() &&
          fault.is_faulty(recording.row[i], recording.index[i], recording.places[i].y()))
        ++missed;
    }
    figures.push_back({"R4", fault.recording + ": faulty readings not set aside",
                       static_cast<double>(missed), 0.0, 0.0});
  }
  for (const std::string name : {"exp4", "exp7", "exp9", "exp10"}) {
    const Recorded recording = recorded(arguments, name);
    const std::vector<Palpation> result = screened(recording.tissue, recording.palpations);
    std::vector<int> readings(100, 0), wrong(100, 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const auto row = static_cast<std::size_t>(recording.row[i]) % readings.size();
      ++readings[row];
      if (is_fault(result[i])) ++wrong[row];
    }
    int rows = 0;
    for (std::size_t row = 0; row < readings.size(); ++row)
      rows += wrong[row] > kFaultyShare * readings[row] ? 1 : 0;
    figures.push_back({"R4", name + ": sound rows set aside", static_cast<double>(rows), 0.0, 1.0});
  }
}

}  // namespace palpation::tool
