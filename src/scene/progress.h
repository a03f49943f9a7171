/// How far long work has come: a bar on a terminal, plain lines otherwise, nothing if quiet. Also
/// where an interrupt is noticed.
#pragma once

#include <string>

namespace palpation::tool {

class Progress {
 public:
  Progress(std::string what, int total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the total, with a word on the state. Throws Interrupted after Ctrl-C and the like.
  /// Safe to call from several threads one after another.
  void step(int done, const std::string& state);

 private:
  std::string what_;
  int total_;
  bool quiet_;
  bool terminal_;
};

}  // namespace palpation::tool
