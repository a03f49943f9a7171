#include "tool/server.h"

#include <utility>

#include "palpation/base/error.h"
#include "scene/gate_setup.h"
#include "scene/next_plan.h"
#include "scene/registration_file.h"
#include "scene/scene_json.h"
#include "scene/scene_session.h"
#include "scene/summary.h"
#include "tool/server_run.h"
#include "tool/server_words.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

/// Any text of the machine's: what is no UTF-8 in it must not stop an answer.
std::string text_of_answer(const json& answer) {
  return answer.dump(-1, ' ', true, json::error_handler_t::replace);
}

json refusal(const std::string& words) { return {{"ok", false}, {"error", words}}; }

}  // namespace

Server::Server(std::filesystem::path folder) : folder_(std::move(folder)) {}
Server::~Server() = default;

std::string Server::answer(std::string_view line) {
  ++lines_;
  json answer, mark;
  try {
    Request request(parse_json(line, "line " + std::to_string(lines_)));
    mark = request.mark();
    answer = act(request);
    answer["ok"] = true;
  } catch (const BadRequest& error) {
    answer = refusal(error.what());
  } catch (const std::bad_alloc&) {
    answer = refusal("not enough memory");
  } catch (const std::exception& error) {
    answer = refusal(error.what());
  }
  if (!mark.is_null()) answer["id"] = mark;
  return text_of_answer(answer);
}

void Server::sync() {
  if (!lost_.empty()) throw WriteError(std::exchange(lost_, ""));
  if (!run_) return;
  try {
    run_->session.sync();
  } catch (const WriteError&) {
    left_run();
    throw;
  }
}

std::string Server::not_synced(const std::string& answer, const std::string& why) {
  const json before = json::parse(answer);
  json now =
      refusal("nothing of this is sure to be on the disk: " + why + ". Open the session again");
  if (before.contains("id")) now["id"] = before.at("id");
  return text_of_answer(now);
}

json Server::act(Request& request) {
  const std::string what = request.text("do");
  if (what == "open") return open(request);
  if (what == "close") return close(request);
  if (what == "next") return next(request);
  if (what == "record") return record(request);
  if (what == "conclude") return conclude(request);
  if (what == "gate") return gate(request);
  if (what == "acknowledge") return acknowledge(request);
  if (what == "show") {
    request.done();
    return state_of_session(run().session.state());
  }
  for (const char* hand_of : {"miss", "withdraw", "touch", "keep-out", "note"})
    if (what == hand_of) return hand(what, request);
  throw BadRequest("\"do\" is " + shown(what) +
                   ", but must be open, next, record, miss, withdraw, touch, keep-out, note, show, "
                   "conclude, gate, acknowledge or close");
}

Server::Run& Server::run() {
  if (!run_)
    throw BadRequest("no session is open: {\"do\": \"open\", \"scene\": ..., \"folder\": ...}");
  return *run_;
}

json Server::open(Request& request) {
  const std::string scene_path = request.text("scene");
  const std::string folder = request.text("folder", folder_.string());
  const std::vector<std::string> overrides = request.texts("set");
  const bool anyway = request.truth("anyway", false);
  request.done();
  if (run_) throw BadRequest("a session is open already: close it first");
  if (folder.empty()) throw BadRequest("\"folder\" is missing: it must be the session's");
  const Scene scene = Scene::read(scene_path, overrides);
  const Tissue tissue = tissue_of(scene);
  run_ = std::make_unique<Run>(
      Run{scene, tissue, Session(folder, session_setup(scene, tissue.surface, anyway)), {}});
  json answer = state_of_session(run_->session.state());
  answer["remarks"] = run_->session.state().plans.empty() ? start_remarks(tissue) : tissue.warnings;
  for (const std::string& remark : run_->session.remarks()) answer["remarks"].push_back(remark);
  if (const std::string remark = registration_remark(scene); !remark.empty())
    answer["remarks"].push_back(remark);
  return answer;
}

json Server::close(Request& request) {
  request.done();
  run();
  const std::unique_ptr<Run> closing = left_run();  // closed, whatever syncing says
  try {
    closing->session.sync();
  } catch (const WriteError& error) {
    lost_ = error.what();
    throw;
  }
  return json::object();
}

std::unique_ptr<Server::Run> Server::left_run() {
  if (run_ && run_->gate) {
    const Gate& gate = *run_->gate;
    held_for_ = gate.held_for();
    if (held_for_.empty() && gate.is_under_way())
      held_for_ = "the session was closed while a touch was under way";
  }
  return std::move(run_);
}

json Server::next(Request& request) {
  request.done();
  return plan_of_answer(run().session.next());
}

json Server::record(Request& request) {
  SessionReading reading{.place = request.triple("place"), .reading = request.number("reading")};
  reading.noise_variance = request.number("noise_variance", reading.noise_variance);
  const std::string kind = request.text("kind", "stop");
  if (kind != "stop" && kind != "way") throw BadRequest("\"kind\" must be stop or way");
  reading.kind = kind == "way" ? TouchKind::Way : TouchKind::Stop;
  if (request.has("travel")) reading.travel = request.triple("travel");
  if (request.has("t")) reading.t_s = request.number("t");
  reading.stop = request.whole_or_none("stop");
  request.done();
  const Recorded recorded = run().session.record(reading);
  json answer{{"number", recorded.number},
              {"new", recorded.is_new},
              {"stop", recorded.stop ? json(*recorded.stop) : json()},
              {"open", run().session.state().open_stops().size()}};
  if (!recorded.off_tissue.empty()) answer["off_tissue"] = recorded.off_tissue;
  return answer;
}

json Server::hand(const std::string& what, Request& request) {
  Session& session = run().session;
  if (what == "miss") {
    const int stop = request.whole("stop");
    const std::string why = request.text("why", "");
    request.done();
    session.miss(stop, why);
  } else if (what == "withdraw") {
    const int number = request.whole("number");
    const std::string why = request.text("why", "");
    request.done();
    session.withdraw(number, why);
  } else if (what == "touch") {
    const Vec3 place = request.triple("place");
    request.done();
    session.touch_first(place);
  } else if (what == "keep-out") {
    const KeepOut ball{request.triple("centre"), request.number("radius")};
    request.done();
    session.keep_out(ball);
  } else {
    const std::string words = request.text("words");
    request.done();
    session.note_refusal(words);
  }
  return {{"open", session.state().open_stops().size()}};
}

json Server::conclude(Request& request) {
  request.done();
  Run& now = run();
  const SessionQuestion question = question_of(now.session.state());
  const Scene asked = scene_asked(now.scene, question);
  const MeasurementsFile measured = measured_on(
      asked, now.tissue.surface, parse_csv(question.measurements_csv, "the session's readings"));
  const Episode episode = episode_from(asked, now.tissue.surface, measured.palpations);
  return {{"summary", summary_of(episode, asked, measured.warnings)}};
}

}  // namespace palpation::tool
