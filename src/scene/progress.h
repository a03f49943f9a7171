/// How far long work has come: a bar on a terminal, plain lines otherwise, nothing if quiet. Also
/// where Ctrl-C is noticed.
#pragma once

#include <stdexcept>
#include <string>

namespace palpation::tool {

/// Ctrl-C was pressed; the tool exits with 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on Ctrl-C sets a mark; if nobody looks at it for two seconds, or at a second Ctrl-C,
/// the program ends with 130.
void watch_for_interrupt();
/// Throws Interrupted if the mark is set.
void check_interrupt();

class Progress {
 public:
  Progress(std::string what, int total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the total, with a word on the state. Throws Interrupted after Ctrl-C. Safe to call
  /// from several threads one after another.
  void step(int done, const std::string& state);

 private:
  std::string what_;
  int total_;
  bool quiet_;
  bool terminal_;
};

}  // namespace palpation::tool
