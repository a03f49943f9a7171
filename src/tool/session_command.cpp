#include "tool/session_command.h"

#include <cstdio>

#include "palpation/base/contract.h"
#include "palpation/session/session.h"
#include "scene/make_folder.h"
#include "scene/progress.h"
#include "scene/registration_file.h"
#include "scene/scene_session.h"
#include "scene/single_file.h"
#include "scene/words.h"
#include "tool/session_words.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

void print(const std::string& words) { std::fputs(words.c_str(), stdout); }

Tissue prepared(const Scene& scene) {
  const Stage preparing("Preparing the tissue", /*quiet=*/false);
  return tissue_of(scene);
}

Session opened(const SessionPlace& place) {
  const Scene scene = Scene::read(place.scene, place.overrides);
  const Tissue tissue = prepared(scene);
  Session session(place.folder, session_setup(scene, tissue.surface, place.anyway));
  if (session.state().plans.empty()) tell(start_remarks(tissue));  // not again with every command
  tell(session.remarks());
  if (const std::string remark = registration_remark(scene); !remark.empty()) tell({remark});
  return session;
}

const HandedOut& planned(Session& session) {
  const Stage planning("Choosing the next stops", /*quiet=*/false);
  return session.next();
}

std::string three_digits(int number) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

/// The poses as files: made from the journal, so that they can be made again.
std::string write_poses(const fs::path& folder, const HandedOut& plan) {
  const fs::path waypoints = folder / ("plan_" + three_digits(plan.number) + "_waypoints.csv"),
                 path = folder / ("plan_" + three_digits(plan.number) + "_path.csv");
  write_single_file(waypoints, plan.plan.waypoints_csv, Existing::Kept);
  write_single_file(path, plan.plan.path_csv, Existing::Kept);
  return "Poses in the robot's frame: " + waypoints.string() + "\n";
}

/// Errors of rows name the file and the line.
template <typename Act>
void at_line(const fs::path& file, int line, const Act& act) {
  try {
    act();
  } catch (const InvalidInput& error) {
    throw IoError(file.string() + ":" + std::to_string(line) + ": " + error.what());
  }
}

/// What is at fault is the caller's number or place, not a function's argument.
template <typename Act>
void as_asked(const Act& act) {
  try {
    act();
  } catch (const InvalidInput& error) {
    throw IoError("session: " + rule_words(error));
  }
}

Vec3 metres(const std::vector<double>& mm) { return Vec3(mm[0], mm[1], mm[2]) / 1000.0; }

void sync_and_tell(Session& session, const std::string& words) {
  session.sync();
  print(words + open_words(session.state()));
}

}  // namespace

void session_show(const SessionPlace& place) {
  if (std::error_code none; !fs::exists(place.folder / "journal.jsonl", none))
    throw IoError(place.folder.string() +
                  ": there is no session here yet: palpate session SCENE.json DIR next begins one");
  print(session_in_words(read_session(place.folder)));
}

void session_next(const SessionPlace& place) {
  Session session = opened(place);
  const HandedOut& plan = planned(session);
  print(plan_in_words(plan));
  if (!plan.stops.empty()) print(write_poses(place.folder, plan) + open_words(session.state()));
}

void session_record(const SessionPlace& place, const SessionWords& words) {
  const Scene scene = Scene::read(place.scene, place.overrides);
  const std::vector<ToldRow> rows =
      read_told(words.readings, scene.gives("reading_unit") ? scene.word("reading_unit") : "");
  Session session = opened(place);
  std::size_t fresh = 0, missed = 0, set_aside = 0;
  std::string odd;
  for (const ToldRow& row : rows) {
    if (row.is_set_aside) {
      ++set_aside;
      continue;
    }
    at_line(words.readings, row.line, [&] {
      if (row.reading.kind == TouchKind::Missed) {
        session.miss(*row.reading.stop, words.why);
        ++missed;
        return;
      }
      const Recorded recorded = session.record(row.reading);
      fresh += recorded.is_new ? 1 : 0;
      if (recorded.is_new && !recorded.off_tissue.empty())
        odd += words.readings.string() + ":" + std::to_string(row.line) + ": " +
               recorded.off_tissue + ": kept as row " + std::to_string(recorded.number) +
               ", but nothing is inferred from it.\n";
    });
  }
  std::string told = counted(fresh, "reading") + " taken";
  if (missed > 0) told += ", " + counted(missed, "missed stop");
  if (set_aside > 0) told += ", " + std::to_string(set_aside) + " set aside by the file";
  if (const std::size_t again = rows.size() - fresh - missed - set_aside; again > 0)
    told += ", " + std::to_string(again) + " known before";
  sync_and_tell(session, odd + told + ".\n");
}

void session_skip(const SessionPlace& place, const SessionWords& words) {
  Session session = opened(place);
  const std::vector<int> stops =
      words.numbers.empty() ? session.state().open_stops() : words.numbers;
  for (const int stop : stops) as_asked([&] { session.miss(stop, words.why); });
  sync_and_tell(session, counted(stops.size(), "stop") + " skipped: not planned again.\n");
}

void session_withdraw(const SessionPlace& place, const SessionWords& words) {
  Session session = opened(place);
  for (const int number : words.numbers) as_asked([&] { session.withdraw(number, words.why); });
  sync_and_tell(session, counted(words.numbers.size(), "reading") + " withdrawn.\n");
}

void session_touch(const SessionPlace& place, const SessionWords& words) {
  Session session = opened(place);
  as_asked([&] { session.touch_first(metres(words.place_mm)); });
  sync_and_tell(session, "The next plan goes there first.\n");
}

void session_keep_out(const SessionPlace& place, const SessionWords& words) {
  Session session = opened(place);
  as_asked([&] { session.keep_out({metres(words.place_mm), words.radius_mm / 1000.0}); });
  sync_and_tell(session, "No stop will be planned there.\n");
}

void session_export(const SessionPlace& place, const SessionExport& where) {
  const Scene scene = Scene::read(place.scene, place.overrides);
  const SessionQuestion question = question_of(read_session(place.folder, where.plan));
  const Existing existing = where.overwrite ? Existing::Replaced : Existing::Kept;
  make_folder(where.folder);
  const fs::path measurements = where.folder / "measurements.csv",
                 asked = where.folder / "scene.json";
  write_single_file(measurements, question.measurements_csv, existing);
  write_single_file(asked, scene_document(scene_asked(scene, question)), existing);
  print("Written: " + measurements.string() + " and " + asked.string() +
        ". palpate plan and boundary on these answer as the session does.\n");
}

}  // namespace palpation::tool
