#include "experiments/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

#include "palpation/belief/memory.h"

namespace palpation::tool {
namespace {

/// A line of /proc/self/status that counts kB.
std::optional<double> megabytes_of(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
  }
  return std::nullopt;
}

/// What was freed goes back to the system, and the peak falls to what is held now.
bool reset_peak() {
  release_memory();
  malloc_trim(0);
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5";
  reset.flush();
  return reset.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  if (reset_peak()) before_ = megabytes_of("VmRSS");
}

std::optional<double> PeakMemory::megabytes() const {
  const std::optional<double> peak = megabytes_of("VmHWM");
  if (!before_ || !peak) return std::nullopt;
  return *peak - *before_;
}

}  // namespace palpation::tool
