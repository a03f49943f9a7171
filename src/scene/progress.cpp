#include "scene/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <utility>

#include "scene/interrupt.h"
#include "scene/status_line.h"
#include "scene/stopwatch.h"

namespace palpation::tool {
namespace {

constexpr int kBarWidth = 20;
constexpr double kWorthTelling_s = 2.0;
constexpr double kMinute_s = 60.0;

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string time_words(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 100) return std::to_string(whole) + " s";
  const long minutes = whole / 60;
  if (minutes < 100) return std::to_string(minutes) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

std::string bar(int done, int total) {
  const auto filled = static_cast<std::size_t>(kBarWidth * std::min(done, total) / total);
  return std::string(filled, '#') + std::string(kBarWidth - filled, '.');
}

}  // namespace

std::string left_words(int done, int total, double pace_s, double now_s) {
  if (done <= 0 || done >= total) return "";
  const double whole_s = pace_s * total / done;
  const double left_s = whole_s - now_s;
  if (whole_s < kWorthTelling_s || left_s <= 0.0) return "";
  const double rounded_s = left_s < kMinute_s ? left_s : std::round(left_s / 10.0) * 10.0;
  return "about " + time_words(std::max(1.0, rounded_s)) + " left";
}

/// What is under way, and since when.
class Progress::Line {
 public:
  Line(const std::string& what, int total)
      : what_(what), total_(total), line_([this] { return words(); }) {}

  void step(int done, const std::string& state) {
    {
      const std::lock_guard lock(guard_);
      done_ = done;
      state_ = state;
      pace_s_ = watch_.seconds();
    }
    line_.draw();
  }

 private:
  std::string words() {
    const std::lock_guard lock(guard_);
    const double now_s = watch_.seconds();
    const std::string left = left_words(done_, total_, pace_s_, now_s);
    return what_ + " [" + bar(done_, total_) + "] " + std::to_string(done_) + "/" +
           std::to_string(total_) + " " + (state_.empty() ? "" : state_ + ", ") +
           (left.empty() ? time_words(now_s) : left);
  }

  std::string what_;
  int total_;
  Stopwatch watch_;
  std::mutex guard_;  // of the following
  int done_ = 0;
  std::string state_;
  double pace_s_ = 0.0;  // how long those took that are done
  StatusLine line_;      // the last, since it calls words()
};

Progress::Progress(std::string what, int total, bool quiet)
    : what_(std::move(what)), total_(std::max(1, total)), quiet_(quiet) {
  if (!quiet_ && is_terminal()) line_ = std::make_unique<Line>(what_, total_);
}

Progress::~Progress() = default;

void Progress::step(int done, const std::string& state) {
  check_interrupt();
  if (line_)
    line_->step(done, state);
  else if (!quiet_)
    std::fprintf(stderr, "%s %d/%d %s\n", what_.c_str(), done, total_, state.c_str());
}

Stage::Stage(std::string what, bool quiet) {
  if (quiet || !is_terminal()) return;
  line_ = std::make_unique<StatusLine>([words = std::move(what), watch = Stopwatch()] {
    return words + ", " + time_words(watch.seconds());
  });
}

Stage::~Stage() = default;

}  // namespace palpation::tool
