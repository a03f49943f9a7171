// A session that dies after any of its operations, the machine with it or not, goes on as if it had
// not.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "session/entries.h"
#include "session/forgetful_files.h"
#include "session/small_run.h"

namespace palpation {
namespace {

const std::filesystem::path kFolder = "/runs/monday";

/// Who drives the session and remembers what was acknowledged.
struct Client {
  std::map<int, std::string> plans;  ///< as they were handed out
  std::size_t rows = 0;              ///< acknowledged

  /// To the end of the session, or to a death.
  void run(const std::shared_ptr<ForgetfulFiles>& files, const Surface& surface, int group) {
    Session session(kFolder, small_setup(surface), files);
    ASSERT_GE(session.state().rows.size(), rows) << "an acknowledged reading is lost";
    for (;;) {
      if (session.state().plans.size() == 3 && session.state().open_stops().empty())
        lay_hand_on(session);
      const HandedOut plan = session.next();
      const std::string text = plan.plan.waypoints_csv;
      const auto [known, is_new] = plans.emplace(plan.number, text);
      ASSERT_EQ(known->second, text) << "plan " << plan.number << " is another one";
      rows = session.state().rows.size();
      if (plan.plan.stops.empty()) return;
      touch_all(session, group);
    }
  }

  void touch_all(Session& session, int group) {
    int since_sync = 0;
    for (const int stop : session.state().open_stops()) {
      const SessionState& state = session.state();
      if (stop == 3 && state.plans.back().number % 2 == 1)
        session.miss(stop, "no contact");
      else
        session.record(felt_at(state, stop));
      if (++since_sync % group != 0) continue;
      session.sync();
      rows = session.state().rows.size();
    }
    session.sync();
    rows = session.state().rows.size();
  }

  /// A person's hand, laid once: who is not told that it was taken looks.
  static void lay_hand_on(Session& session) {
    if (session.state().rows[4].withdrawn.empty()) session.withdraw(5, "slipped");
    const Vec3 centre(0.001, 0.001, 0.0);
    if (session.state().keep_out.empty()) session.keep_out({centre, 0.0005});
    const bool asked = !session.state().touch_first.empty() || session.state().plans.size() > 3;
    if (!asked) session.touch_first(Vec3(0.010, 0.010, 0.0));
    session.sync();
  }
};

struct Finished {
  std::string measurements;
  std::map<int, std::string> plans;
};

/// Without any death.
Finished undisturbed(const Surface& surface, int group, int* operations) {
  const auto files = std::make_shared<ForgetfulFiles>();
  Client client;
  client.run(files, surface, group);
  *operations = files->operations();
  const Session session(kFolder, small_setup(surface), files);
  return {measurements_csv(session.state()), client.plans};
}

void expect_as(const Finished& expected, const std::shared_ptr<ForgetfulFiles>& files,
               const Client& client, const Surface& surface, const std::string& which) {
  const Session session(kFolder, small_setup(surface), files);
  EXPECT_EQ(measurements_csv(session.state()), expected.measurements) << which;
  EXPECT_EQ(client.plans, expected.plans) << which;
}

TEST(Deaths, AfterEveryOperationLoseNothingTakeNothingTwiceAndPlanAlike) {
  const Surface surface = small_tissue();
  Random random(1);
  int deaths = 0;
  for (const int group : {1, 3}) {
    int operations = 0;
    const Finished expected = undisturbed(surface, group, &operations);
    ASSERT_EQ(expected.plans.size(), 6u);
    for (const Left left : {Left::All, Left::Nothing, Left::Part, Left::Holes}) {
      for (int after = 1; after <= operations; ++after) {
        const bool in_the_middle = after % 2 == 0;
        const auto files = std::make_shared<ForgetfulFiles>();
        files->die_after(after, in_the_middle);
        Client client;
        EXPECT_THROW(client.run(files, surface, group), Death);
        ++deaths;
        files->start_again(left, random);
        client.run(files, surface, group);
        const std::string which = "died after " + std::to_string(after) + " operations, left " +
                                  std::to_string(static_cast<int>(left));
        expect_as(expected, files, client, surface, which);
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(deaths, 400);
}

TEST(Deaths, OneAfterAnotherLoseNothingEither) {
  const Surface surface = small_tissue();
  Random random(2);
  int operations = 0, deaths = 0;
  const Finished expected = undisturbed(surface, 2, &operations);
  for (int run = 0; run < 2300; ++run) {
    const auto files = std::make_shared<ForgetfulFiles>();
    Client client;
    for (bool is_done = false; !is_done;) {
      files->die_after(1 + random.below(25), random.below(2) == 0);
      try {
        client.run(files, surface, 2);
        files->die_after(-1);
        is_done = true;
      } catch (const Death&) {
        ++deaths;
      }
      files->start_again(static_cast<Left>(random.below(4)), random);
      if (HasFatalFailure()) return;
    }
    expect_as(expected, files, client, surface, "run " + std::to_string(run));
    if (HasFailure()) return;
  }
  EXPECT_GT(deaths, 10'000);
}

}  // namespace
}  // namespace palpation
