#include "scene/progress.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <utility>

namespace palpation::tool {
namespace {

constexpr int kBarWidth = 30;
constexpr int kInterruptedCode = 130;
volatile std::sig_atomic_t interrupted = 0;

constexpr unsigned kPatience_s = 2;

/// Long arithmetic does not look at the mark: then the program ends by itself. Files are renamed
/// only when they are whole, so nothing is half-written.
void on_interrupt(int) {
  if (interrupted != 0) ::_exit(kInterruptedCode);
  interrupted = 1;
  ::alarm(kPatience_s);
}

void on_alarm(int) { ::_exit(kInterruptedCode); }

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGALRM, on_alarm);
}

void check_interrupt() {
  if (interrupted != 0) throw Interrupted();
}

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
