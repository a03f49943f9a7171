#include "scene/status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>

namespace palpation::tool {
namespace {

constexpr std::chrono::seconds kTick{1};
constexpr std::size_t kNarrowest = 20, kUsual = 80;

std::mutex drawing;  // of the terminal and of what follows
bool is_drawn = false;

/// Longer lines would wrap, and what wraps is not wiped.
std::size_t columns() {
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return std::max<std::size_t>(kNarrowest, is_known ? size.ws_col : kUsual);
}

/// To be called with the terminal held.
void wipe() {
  if (!std::exchange(is_drawn, false)) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
}

}  // namespace

bool is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

StatusLine::StatusLine(std::function<std::string()> words) : words_(std::move(words)) {
  try {
    thread_ = std::thread([this] { tick(); });
  } catch (const std::system_error&) {
    // No thread is to be had: it is drawn when it is told to.
  }
}

StatusLine::~StatusLine() {
  {
    const std::lock_guard lock(guard_);
    ends_ = true;
  }
  end_.notify_all();
  if (thread_.joinable()) thread_.join();
  wiped();
}

void StatusLine::draw() {
  const std::string words = words_().substr(0, columns() - 1);
  const std::lock_guard lock(drawing);
  std::fprintf(stderr, "\r\x1b[K%s", words.c_str());
  std::fflush(stderr);
  is_drawn = true;
}

std::unique_lock<std::mutex> StatusLine::wiped() {
  std::unique_lock lock(drawing);
  wipe();
  return lock;
}

void StatusLine::tick() {
  std::unique_lock lock(guard_);
  while (!end_.wait_for(lock, kTick, [this] { return ends_; })) draw();
}

}  // namespace palpation::tool
