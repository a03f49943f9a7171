/// Ctrl-C, SIGTERM and SIGHUP: they end the program alike, with words and the exit code 130.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace palpation::tool {

/// Thrown where the mark is looked at.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& signal)
      : std::runtime_error("interrupted by " + signal) {}
};

/// From now on such a signal sets a mark; if the program has not ended two seconds later, or at a
/// second signal, it is ended with 130. A hang-up that was ignored at the start (nohup) still is.
/// Where no thread can be started, signals end the program as they end any.
/// To be called before any thread is started.
void watch_for_interrupt();

bool is_interrupted();
/// Throws Interrupted if the mark is set.
void check_interrupt();

/// What is still to be done when the program is ended from outside of its own course: long
/// arithmetic does not look at the mark. At most one at a time; called on another thread, which
/// nothing else waits for.
class LastWords {
 public:
  explicit LastWords(std::function<void()> say);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
};

}  // namespace palpation::tool
