#include "python/open_session.h"

#include <dlfcn.h>

#include <set>
#include <utility>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/digest.h"
#include "scene/next_plan.h"
#include "scene/scene_session.h"
#include "session/entries.h"
#include "session/journal.h"
#include "session/reading_checks.h"

namespace palpation::python {
namespace {

tool::Scene scene_of(const SceneAsked& asked) {
  if (!asked.path.empty()) return tool::Scene::read(asked.path, asked.overrides);
  return tool::Scene::parse(asked.text, "the scene", std::filesystem::current_path(),
                            asked.overrides);
}

/// The program that plans is this module's file, whatever interpreter has loaded it.
std::string own_version() {
  static const std::string version = [] {
    Dl_info file{};
    const bool is_known = dladdr(reinterpret_cast<const void*>(&own_version), &file) != 0;
    const std::string bytes = is_known ? read_file(file.dli_fname) : std::string();
    return PALPATION_VERSION " " + tool::digest(std::string_view(bytes));
  }();
  return version;
}

SessionSetup setup_of(const tool::Scene& scene, const Surface& surface, bool anyway) {
  SessionSetup setup = tool::session_setup(scene, surface, anyway);
  setup.identity.version = own_version();
  return setup;
}

/// The row of a stop that could not be touched.
int row_of_missed(const SessionState& state, int stop) {
  for (std::size_t i = state.rows.size(); i-- > 0;) {
    const SessionReading& made = state.rows[i].made;
    if (made.kind == TouchKind::Missed && made.stop == stop) return static_cast<int>(i) + 1;
  }
  return 0;
}

}  // namespace

OpenSession::OpenSession(const SceneAsked& asked, std::filesystem::path folder, bool anyway)
    : folder_(std::move(folder)),
      scene_(scene_of(asked)),
      tissue_(tool::tissue_of(scene_)),
      session_(folder_, setup_of(scene_, tissue_.surface, anyway)),
      remarks_(state().plans.empty() ? tool::start_remarks(tissue_) : tissue_.warnings) {
  remarks_.insert(remarks_.end(), session_.remarks().begin(), session_.remarks().end());
}

void OpenSession::check_all(const std::vector<Told>& told) const {
  const std::vector<StopState> stops =
      state().plans.empty() ? std::vector<StopState>() : state().plans.back().stops;
  std::set<int> touched;
  for (std::size_t row = 0; row < told.size(); ++row) {
    const SessionReading& made = told[row].made;
    const std::string function = "Session.record: row " + std::to_string(row);
    const int stop = made.stop.value_or(0);
    require(!made.stop || (stop >= 0 && static_cast<std::size_t>(stop) < stops.size()), function,
            "stop " + std::to_string(stop),
            "must be one of the plan's " + std::to_string(stops.size()) + ", from 0");
    if (made.kind != TouchKind::Missed) {
      check(made, function);
      if (made.stop) touched.insert(stop);
      continue;
    }
    require(made.stop.has_value(), function, "NaN",
            "is a stop that could not be touched: name it by `stop`");
    const StopState now = stops[static_cast<std::size_t>(stop)];
    require(now != StopState::Touched && !touched.contains(stop), function,
            "stop " + std::to_string(stop), "was touched");
    require(now != StopState::Dropped, function, "stop " + std::to_string(stop),
            "was dropped with its plan");
  }
}

std::vector<Recorded> OpenSession::record(const std::vector<Told>& told) {
  check_all(told);
  std::vector<Recorded> recorded;
  for (const Told& one : told) {
    if (one.made.kind != TouchKind::Missed) {
      recorded.push_back(session_.record(one.made));
      continue;
    }
    const int stop = *one.made.stop;
    const std::size_t rows = state().rows.size();
    session_.miss(stop, one.why);
    recorded.push_back({.number = row_of_missed(state(), stop),
                        .is_new = state().rows.size() > rows,
                        .stop = stop});
  }
  session_.sync();
  return recorded;
}

Concluded OpenSession::conclude() const {
  const SessionQuestion question = question_of(state());
  const tool::Scene asked = tool::scene_asked(scene_, question);
  const MeasurementsFile measured = tool::measured_on(
      asked, tissue_.surface, parse_csv(question.measurements_csv, "the session's readings"));
  const tool::Episode episode = tool::episode_from(asked, tissue_.surface, measured.palpations);
  return Concluded(episode.exploration.surface(), episode.conclusion());
}

std::vector<std::string> journal_lines(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kJournalName;
  std::vector<std::string> lines;
  for (const auto& line : parse_journal(read_file(path), path.string()).lines)
    lines.push_back(line.dump());
  return lines;
}

}  // namespace palpation::python
