#include "scene/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "scene/interrupt.h"

namespace palpation::tool {
namespace {

constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(std::string what, int total, bool quiet)
    : what_(std::move(what)),
      total_(std::max(1, total)),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (!quiet_ && terminal_) std::fprintf(stderr, "\r\x1b[K");
}

void Progress::step(int done, const std::string& state) {
  check_interrupt();
  if (quiet_) return;
  const int filled = kBarWidth * std::min(done, total_) / total_;
  if (terminal_) {
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kBarWidth - filled), '.');
    std::fprintf(stderr, "\r\x1b[K%s [%s] %d/%d %s", what_.c_str(), bar.c_str(), done, total_,
                 state.c_str());
    std::fflush(stderr);
  } else {
    std::fprintf(stderr, "%s %d/%d %s\n", what_.c_str(), done, total_, state.c_str());
  }
}

}  // namespace palpation::tool
