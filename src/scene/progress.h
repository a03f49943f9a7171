/// How far long work has come: a line on a terminal that changes each second and goes away; of
/// counted work plain lines elsewhere; nothing if quiet. Also where an interrupt is noticed.
///
/// On a terminal the line says for how long the work has been going, and once something of it is
/// done how long the rest will take at that pace. It is never written into a file or a pipe.
#pragma once

#include <memory>
#include <string>

namespace palpation::tool {

class StatusLine;

/// Work whose parts are counted, such as batches.
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
  class Line;
  std::string what_;
  int total_;
  bool quiet_;
  std::unique_ptr<Line> line_;  // null where there is no terminal
};

/// Work that is one piece, "Drawing the picture": told on a terminal, while it lives, if it takes a
/// second. One at a time, and none while there is a Progress.
class Stage {
 public:
  Stage(std::string what, bool quiet);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  std::unique_ptr<StatusLine> line_;
};

/// "about 12 s left", of work of which so many parts of a total took `pace_s`, `now_s` after its
/// beginning. Empty where that says nothing: none is done, or all; the whole takes less than two
/// seconds; or what is left takes longer already than at that pace.
std::string left_words(int done, int total, double pace_s, double now_s);

}  // namespace palpation::tool
