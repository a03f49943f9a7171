/// The last line of a terminal, which says what is under way.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace palpation::tool {

/// Whether standard error is one.
bool is_terminal();

/// Draws what a function says, each second and whenever it is told to, and wipes it at its end. The
/// function is called in a thread of its own, too.
class StatusLine {
 public:
  explicit StatusLine(std::function<std::string()> words);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void draw();

  /// Held, nothing is drawn; empty where nothing was.
  static std::unique_lock<std::mutex> wiped();

 private:
  void tick();

  std::function<std::string()> words_;
  std::mutex guard_;  // of ends_
  std::condition_variable end_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace palpation::tool
