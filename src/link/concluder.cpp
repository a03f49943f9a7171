#include "link/concluder.h"

#include <sys/resource.h>

#include <new>
#include <utility>

#include "link/messages.h"
#include "palpation/base/interruption.h"
#include "palpation/io/csv.h"
#include "results/shown.h"
#include "results/verdict.h"
#include "scene/believed.h"
#include "scene/next_plan.h"
#include "scene/scene_session.h"

namespace palpation::link {
namespace {

constexpr int kGivesWay = 10;  // as `nice` does

/// Thrown where the work is ended: no std::exception, which a step may take for its own failure.
struct Ended {};

std::string words_of(const results::Run& run) {
  std::string words = results::verdict_of(run, "");
  for (const std::string& sentence : results::scope_of(run)) words += "\n" + sentence;
  for (const auto& warning : run.told({"warnings"}))
    if (warning.is_string()) words += "\n" + warning.get<std::string>();
  return words;
}

/// The session's number of each row that is exported.
std::vector<int> numbers_of(const SessionState& state) {
  std::vector<int> numbers;
  for (std::size_t i = 0; i < state.rows.size(); ++i)
    if (state.rows[i].off_tissue.empty()) numbers.push_back(static_cast<int>(i) + 1);
  return numbers;
}

}  // namespace

Concluded concluded(const tool::Scene& scene, const tool::Tissue& tissue, Frame frame,
                    const SessionState& state) {
  const SessionQuestion question = question_of(state);
  const tool::Scene asked = tool::scene_asked(scene, question);
  const CsvTable table = parse_csv(question.measurements_csv, "the session's readings");
  const MeasurementsFile measured = tool::measured_on(asked, tissue.surface, table);
  const tool::Episode episode = tool::episode_from(asked, tissue.surface, measured.palpations);
  const results::Run run = tool::believed_run(asked, tissue, episode, measured.warnings);
  Concluded result{.rows = state.rows.size()};
  const Vec3 anchor = tissue.surface.vertex(0);
  for (const results::NamedModel& model : results::models_of(run))
    if (model.name != "true_outline")  // which no session knows
      result.messages.push_back(
          {model.name, "POLYDATA", polydata_message(model.name, model.shape, anchor, frame)});
  result.messages.push_back({"conclusion", "STRING", string_message("conclusion", words_of(run))});
  const std::vector<int> numbers = numbers_of(state);
  if (numbers.size() != run.touches.size()) return result;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!run.touches[i].set_aside.empty()) result.set_aside[numbers[i]] = run.touches[i].set_aside;
  return result;
}

Concluder::Concluder(tool::Scene scene, tool::Tissue tissue, Frame frame)
    : scene_(std::move(scene)),
      tissue_(std::move(tissue)),
      frame_(frame),
      thread_([this] { work(); }) {}

Concluder::~Concluder() {
  {
    const std::lock_guard lock(guard_);  // or the thread may be about to wait
    ends_ = true;
  }
  news_.notify_all();
  thread_.join();
}

void Concluder::ask(SessionState state) {
  const std::lock_guard lock(guard_);
  asked_ = std::move(state);
  is_busy_ = true;
  news_.notify_all();
}

std::optional<Concluded> Concluder::done() {
  const std::lock_guard lock(guard_);
  return std::exchange(done_, std::nullopt);
}

bool Concluder::is_busy() const {
  const std::lock_guard lock(guard_);
  return is_busy_;
}

void Concluder::work() {
  ::setpriority(PRIO_PROCESS, 0, kGivesWay);  // of this thread, as Linux has it
  for (;;) {
    std::unique_lock lock(guard_);
    news_.wait(lock, [this] { return ends_ || asked_; });
    if (ends_) return;
    const SessionState state = *std::exchange(asked_, std::nullopt);
    lock.unlock();
    Concluded result;
    try {
      result = answer(state);
    } catch (const Ended&) {
      return;
    }
    lock.lock();
    done_ = std::move(result);
    is_busy_ = asked_.has_value();
  }
}

Concluded Concluder::answer(const SessionState& state) const {
  const Interruptible scope([this] {
    if (ends_) throw Ended();
  });
  try {
    return concluded(scene_, tissue_, frame_, state);
  } catch (const std::bad_alloc&) {
    return {.rows = state.rows.size(), .fault = "not enough memory"};
  } catch (const std::exception& error) {
    return {.rows = state.rows.size(), .fault = error.what()};
  }
}

}  // namespace palpation::link
