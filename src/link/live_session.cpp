#include "link/live_session.h"

#include <cmath>
#include <utility>

#include "link/messages.h"
#include "palpation/base/error.h"
#include "scene/scene_session.h"
#include "scene/setup.h"
#include "scene/words.h"
#include "session/differences.h"

namespace palpation::link {
namespace {

std::string word_of(TouchKind kind) {
  if (kind == TouchKind::Missed) return "missed";
  return kind == TouchKind::Way ? "way" : "stop";
}

/// The session's rows, with what the latest conclusion set aside.
std::vector<results::Touch> touches_of(const SessionState& state,
                                       const std::map<int, std::string>& set_aside) {
  std::vector<results::Touch> touches;
  for (const SessionRow& row : state.rows) {
    results::Touch touch{.number = static_cast<int>(touches.size()) + 1,
                         .place = row.made.place,
                         .reading = std::nullopt,
                         .batch = row.batch,
                         .kind = word_of(row.made.kind),
                         .set_aside = row.withdrawn.empty() ? row.off_tissue : row.withdrawn};
    if (std::isfinite(row.made.reading)) touch.reading = row.made.reading;
    if (const auto found = set_aside.find(touch.number);
        touch.set_aside.empty() && found != set_aside.end())
      touch.set_aside = found->second;
    touches.push_back(std::move(touch));
  }
  return touches;
}

/// "plan 2: 3 of 4 stops are open".
std::string plan_words(const SessionState& state) {
  if (state.plans.empty()) return "no plan yet";
  const HandedOut& plan = state.plans.back();
  const std::string name = "plan " + std::to_string(plan.number);
  if (plan.stops.empty()) return name + ": nothing more to touch: " + plan.plan.stop_reason;
  return name + ": " + std::to_string(state.open_stops().size()) + " of " +
         tool::counted(plan.stops.size(), "stop") + " open";
}

}  // namespace

LiveSession::LiveSession(const std::filesystem::path& folder, const tool::Scene& scene,
                         const tool::Tissue& tissue, Frame frame)
    : tissue_(tissue),
      frame_(frame),
      identity_(tool::session_setup(scene, tissue.surface, false).identity),
      watch_(folder),
      path_(tissue.surface, tool::robot_of(scene)),
      concluder_(scene, tissue, frame) {
  state_ = watch_.changed().value();
  if (const std::string words = stale_words(state_.identity); !words.empty())
    throw IoError(folder.string() + ": " + words);
}

std::string LiveSession::look(LinkServer& server) {
  std::string words = look_at_journal(server);
  const std::string more = look_at_conclusion(server);
  if (!words.empty() && !more.empty()) words += "; ";
  return words + more;
}

std::string LiveSession::look_at_journal(LinkServer& server) {
  const bool is_first = std::exchange(is_new_, false);
  if (is_first) show_tissue(server);
  try {
    std::optional<SessionState> now = watch_.changed();
    if (!now && !is_first) return "";
    if (now) state_ = std::move(*now);
    fault_ = stale_words(state_.identity);
  } catch (const Error& error) {
    fault_ = error.what();
  }
  if (fault_.empty()) {
    pose_ = path_.last_of(state_.rows);
    show_journal(server);
    concluder_.ask(state_);
  }
  show_status(server);
  return fault_;
}

std::string LiveSession::look_at_conclusion(LinkServer& server) {
  std::optional<Concluded> news = concluder_.done();
  if (!news) return "";
  if (news->fault.empty()) {
    for (Shown& message : news->messages) server.show(std::move(message));
    set_aside_ = std::move(news->set_aside);
    concluded_rows_ = news->rows;
    show_journal(server);
  } else if (fault_.empty()) {
    fault_ =
        "nothing can be concluded from " + tool::counted(news->rows, "row") + ": " + news->fault;
  }
  show_status(server);
  return news->fault.empty() ? "" : fault_;
}

/// Without fields, which take their time.
void LiveSession::show_tissue(LinkServer& server) const {
  VtpShape shape;
  const TriangleMesh& mesh = tissue_.surface.mesh();
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
    shape.points.emplace_back(mesh.vertices.row(i));
  for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i)
    shape.triangles.push_back({mesh.triangles(i, 0), mesh.triangles(i, 1), mesh.triangles(i, 2)});
  server.show({"tissue", "POLYDATA", polydata_message("tissue", shape, Vec3::Zero(), frame_)});
}

void LiveSession::show_journal(LinkServer& server) const {
  results::Run run;
  run.touches = touches_of(state_, set_aside_);
  for (const int stop : state_.open_stops())
    run.next_stops.push_back(state_.plans.back().plan.stops[static_cast<std::size_t>(stop)]);
  for (results::NamedMarks& list : results::marks_of(run)) {
    if (list.name == "next_stops")  // by their indices in the plan, as a session calls them
      for (std::size_t i = 0; i < list.marks.size(); ++i)
        list.marks[i].label = std::to_string(state_.open_stops()[i]);
    server.show({list.name, "POINT", point_message(list, frame_)});
  }
  if (pose_)
    server.show(
        {"probe", "TRANSFORM", transform_message("probe", pose_->rotation, pose_->place, frame_)});
}

void LiveSession::show_status(LinkServer& server) const {
  std::string words = fault_;
  Status status = Status::UnknownError;
  if (fault_.empty()) {
    const bool is_behind = concluded_rows_ != state_.rows.size() || concluder_.is_busy();
    status = is_behind ? Status::Busy : Status::Ok;
    words = tool::counted(state_.rows.size(), "row") + "; " + plan_words(state_) + "; ";
    words += concluded_rows_
                 ? "tissue and outlines are of " + tool::counted(*concluded_rows_, "row")
                 : "nothing is concluded yet";
    if (is_behind) words += ", those of " + std::to_string(state_.rows.size()) + " are under way";
  }
  server.show({"palpate", "STATUS", status_message("palpate", status, words)});
}

std::string LiveSession::stale_words(const SessionIdentity& now) const {
  SessionIdentity same_version = identity_;
  same_version.version = now.version;  // another build of palpate may look on
  const std::string what = differences(now, same_version);
  if (what.empty()) return "";
  return "the session is of something else than was given: " + what +
         " (then: the session's; now: what was given). Give palpate link the scene and --set that "
         "the session goes by";
}

}  // namespace palpation::link
