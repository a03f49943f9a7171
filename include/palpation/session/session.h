/// A real run, step by step, that loses nothing: an exploration whose every word is on disk before
/// it is acted on.
///
///     Session session("run7", {.surface = tissue, .planner = planner, .identity = {...}});
///     while (!session.next().plan.stops.empty()) {
///       for (const int stop : session.state().open_stops()) session.record(touch(stop));
///       session.sync();
///     }
///
/// A folder holds a journal, to which lines are only added: what the session is of, each plan
/// before it is handed out, each reading as it came, stops that could not be touched, refusals, and
/// a person's hand. Laws: (1) what sync() acknowledged is there after any death, of the process or
/// of the machine; (2) opened again, next() is what it would have been without the death, to the
/// byte; (3) a reading that is told again in the time of its plan, alike in everything, is taken
/// once; (4) a plan follows from state() alone, by question_of; (5) one writer at a time, readers
/// always.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/session/session_state.h"

namespace palpation {

class FileLayer;

/// A function of its argument alone. Where to touch first is first in the plan.
using SessionPlanner = std::function<SessionPlan(const SessionQuestion&)>;

struct SessionSetup {
  Surface surface;
  SessionPlanner planner;
  SessionIdentity identity;
  std::function<std::string()> clock{};  ///< when a line is written, in any words; empty: not said
  bool anyway = false;  ///< go on where scene, tissue or version changed and the next plan with it
};

/// What became of a reading.
struct Recorded {
  int number = 0;             ///< of its row, from 1
  bool is_new = true;         ///< or it had been told before
  std::optional<int> stop{};  ///< that it answers
  std::string off_tissue{};   ///< why it will not be used; empty: it will
};

/// The farthest from a stop, along the tissue, where a reading that names none answers it.
inline constexpr double kStopReach_m = 0.001;

class Session {
 public:
  /// Opens the folder, or makes it. Throws IoError for a journal that is corrupted, naming the
  /// line, and where what changed since changes the next plan, unless `anyway`; WriteError where
  /// another process writes there, or nothing can be written; and what the planner throws.
  Session(const std::filesystem::path& folder, SessionSetup setup);
  /// The same on other files.
  Session(const std::filesystem::path& folder, SessionSetup setup,
          std::shared_ptr<FileLayer> files);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// What was noticed on opening, a sentence each: what changed since, what a death left.
  const std::vector<std::string>& remarks() const;
  const SessionState& state() const;

  /// The plan whose stops are open; once something has become of all of them, the next one, which
  /// is on disk before it is returned. Valid until the next call. Throws what the planner throws;
  /// then nothing has changed.
  const HandedOut& next();

  /// A reading, not acknowledged before sync(). Throws InvalidInput, and takes nothing, for one
  /// that is none: place, reading, variance, travel or time not finite or beyond what
  /// measurements.h allows, or a stop that the plan does not have.
  Recorded record(const SessionReading& reading);
  /// A stop could not be touched. Nothing where that was told before. Throws InvalidInput where it
  /// is no stop of the plan, or was touched.
  void miss(int stop, const std::string& why);
  /// A person's hand. Throws InvalidInput for a row that is no reading or was withdrawn before; a
  /// place that is off the tissue or kept out; a radius that is not positive.
  void withdraw(int number, const std::string& why);
  void touch_first(const Vec3& place);
  /// Stops of the plan in there that are open could not be touched, places to be touched first are
  /// forgotten.
  void keep_out(const KeepOut& ball);
  /// What was refused, such as a motion, for who reads the journal.
  void note_refusal(const std::string& words);

  /// All of the above is on disk when this returns. Throws WriteError; then the session must be
  /// opened again.
  void sync();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace palpation
