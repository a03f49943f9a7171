#include "palpation/session/session.h"

#include <algorithm>
#include <utility>

#include "io/landing.h"
#include "palpation/base/error.h"
#include "session/differences.h"
#include "session/entries.h"
#include "session/journal.h"
#include "session/reading_checks.h"

namespace palpation {
namespace {

using nlohmann::json;

/// The same stops in the same order, the same poses, and the same reason for none.
bool is_same(const SessionPlan& a, const SessionPlan& b) {
  return a.stops == b.stops && a.stop_reason == b.stop_reason &&
         a.waypoints_csv == b.waypoints_csv && a.path_csv == b.path_csv;
}

}  // namespace

class Session::Work {
 public:
  Work(const std::filesystem::path& folder, SessionSetup setup, std::shared_ptr<FileLayer> files)
      : setup_(std::move(setup)),
        path_(folder / kJournalName),
        landing_(setup_.surface),
        journal_(std::move(files), path_) {
    if (journal_.was_torn())
      remarks_.push_back(path_.string() +
                         ": its last line was cut short by a death, was never acknowledged, and "
                         "is gone.");
    for (const json& entry : journal_.lines()) apply(state_, entry, path_.string());
    if (journal_.lines().empty())
      write(first_entry(setup_.identity));
    else if (state_.identity != setup_.identity)
      take_up_change();
    journal_.commit();
  }

  /// A line of the journal, and what it does.
  void write(json entry) {
    if (setup_.clock) entry["at"] = setup_.clock();
    journal_.add(entry);
    apply(state_, entry, path_.string());
  }

  void commit() { journal_.commit(); }

  const HandedOut& next() {
    const bool is_in_force =
        !state_.plans.empty() && (!state_.open_stops().empty() ||
                                  (state_.plans.back().plan.stops.empty() && !state_.has_news));
    if (!is_in_force) write(plan_entry(planned(), checksum_of(measurements_csv(state_))));
    journal_.commit();
    return state_.plans.back();
  }

  Recorded record(const SessionReading& reading) {
    check(reading, "Session::record");
    if (const auto known = told_before(reading)) return *known;
    if (reading.stop) require_stop(*reading.stop, "Session::record");
    Recorded recorded{.number = static_cast<int>(state_.rows.size()) + 1, .stop = reading.stop};
    const auto place = landing_.place(reading.place, recorded.off_tissue);
    if (!place) recorded.stop = std::nullopt;
    if (place && !reading.stop && reading.kind == TouchKind::Stop && !state_.plans.empty())
      recorded.stop = nearest_stop(setup_.surface.position(*place), state_.open_stops(),
                                   state_.plans.back().plan.stops);
    write(reading_entry(reading, recorded.stop, recorded.off_tissue));
    return recorded;
  }

  void miss(int stop, const std::string& why) {
    require_stop(stop, "Session::miss");
    const StopState now = state_.plans.back().stops[static_cast<std::size_t>(stop)];
    require(now != StopState::Touched, "Session::miss", "stop " + std::to_string(stop),
            "was touched");
    if (now == StopState::Open) write(missed_entry(stop, one_line(why, "could not be touched")));
  }

  void withdraw(int number, const std::string& why) {
    const std::string what = "row " + std::to_string(number);
    require(number >= 1 && number <= static_cast<int>(state_.rows.size()), "Session::withdraw",
            what, "must be one of the session's " + std::to_string(state_.rows.size()));
    const SessionRow& row = state_.rows[static_cast<std::size_t>(number) - 1];
    require(row.made.kind != TouchKind::Missed, "Session::withdraw", what,
            "is a stop that could not be touched: there is no reading to withdraw");
    require(row.withdrawn.empty(), "Session::withdraw", what,
            "was withdrawn before: " + row.withdrawn);
    write(withdrawn_entry(number, one_line(why, "yes")));
  }

  void touch_first(const Vec3& place) {
    require(place.allFinite(), "Session::touch_first", "place", "must be finite, in metres");
    std::string fault;
    const auto on_tissue = landing_.place(place, fault);
    require(on_tissue.has_value(), "Session::touch_first", "place", "is off the tissue: " + fault);
    const Vec3 position = setup_.surface.position(*on_tissue);
    for (const KeepOut& ball : state_.keep_out)
      require((position - ball.centre).norm() > ball.radius_m, "Session::touch_first", "place",
              "lies where a person said to keep out");
    write(touch_entry(place));
  }

  void keep_out(const KeepOut& ball) {
    require(ball.centre.allFinite() && ball.radius_m > 0.0 && ball.radius_m <= 1e3,
            "Session::keep_out", "ball", "must have a finite centre and a positive radius [m]");
    write(keep_out_entry(ball));
  }

  const std::vector<std::string>& remarks() const { return remarks_; }
  const SessionState& state() const { return state_; }

 private:
  HandedOut planned() const {
    HandedOut plan{.number = static_cast<int>(state_.plans.size()),
                   .batch = next_batch(state_),
                   .plan = setup_.planner(question_of(state_)),
                   .used = rows_used(state_)};
    return plan;
  }

  /// Another scene, tissue or version: told, and refused where the last plan would be another.
  void take_up_change() {
    const std::string what = differences(state_.identity, setup_.identity);
    const std::string words = path_.string() + ": since the last time " + what + " changed";
    bool is_equal = true;
    if (!state_.plans.empty()) {
      SessionState then;
      for (const json& entry : journal_.lines()) {
        if (plan_number_of(entry) == state_.plans.back().number) break;
        apply(then, entry, path_.string());
      }
      is_equal = is_same(setup_.planner(question_of(then)), state_.plans.back().plan);
      if (!is_equal && !setup_.anyway)
        throw IoError(words +
                      ", and the last plan would have been another: what was felt does "
                      "not belong to it. Restore what it was; or go on with --anyway, which "
                      "drops what is open of that plan and makes a new one");
    }
    remarks_.push_back(words + (is_equal ? "; the plan does not." : ", and plans with it."));
    write(change_entry(setup_.identity, !is_equal));
  }

  void require_stop(int stop, const std::string& function) const {
    const std::size_t count = state_.plans.empty() ? 0 : state_.plans.back().stops.size();
    require(stop >= 0 && static_cast<std::size_t>(stop) < count, function,
            "stop " + std::to_string(stop),
            "must be one of the plan's " + std::to_string(count) + ", from 0");
  }

  /// In the time of the plan.
  std::optional<Recorded> told_before(const SessionReading& reading) const {
    const int plan = state_.plans.empty() ? -1 : state_.plans.back().number;
    for (std::size_t i = state_.rows.size(); i-- > 0 && state_.rows[i].plan == plan;) {
      const SessionRow& row = state_.rows[i];
      if (palpation::is_same(row.made, reading))
        return Recorded{static_cast<int>(i) + 1, false, row.made.stop, row.off_tissue};
    }
    return std::nullopt;
  }

  SessionSetup setup_;
  std::filesystem::path path_;
  Landing landing_;  // of setup_'s surface
  Journal journal_;
  SessionState state_;
  std::vector<std::string> remarks_;
};

Session::Session(const std::filesystem::path& folder, SessionSetup setup)
    : Session(folder, std::move(setup), disk_layer()) {}

Session::Session(const std::filesystem::path& folder, SessionSetup setup,
                 std::shared_ptr<FileLayer> files)
    : work_(std::make_unique<Work>(folder, std::move(setup), std::move(files))) {}

Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const std::vector<std::string>& Session::remarks() const { return work_->remarks(); }
const SessionState& Session::state() const { return work_->state(); }
const HandedOut& Session::next() { return work_->next(); }
Recorded Session::record(const SessionReading& reading) { return work_->record(reading); }
void Session::miss(int stop, const std::string& why) { work_->miss(stop, why); }
void Session::withdraw(int number, const std::string& why) { work_->withdraw(number, why); }
void Session::touch_first(const Vec3& place) { work_->touch_first(place); }
void Session::keep_out(const KeepOut& ball) { work_->keep_out(ball); }
void Session::note_refusal(const std::string& words) {
  work_->write(refusal_entry(one_line(words, "refused")));
}
void Session::sync() { work_->commit(); }

}  // namespace palpation
