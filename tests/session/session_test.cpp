#include "palpation/session/session.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "session/entries.h"
#include "session/forgetful_files.h"
#include "session/small_run.h"

namespace palpation {
namespace {

const std::filesystem::path kFolder = "/run";

class SessionTest : public testing::Test {
 protected:
  Session open(SessionSetup setup) { return Session(kFolder, std::move(setup), files_); }
  Session open() { return open(small_setup(surface_)); }
  std::string& journal() { return files_->content(kFolder / kJournalName); }

  /// Changes a byte of a line, from 1.
  void damage(int line) {
    std::size_t at = 0;
    for (int i = 1; i < line; ++i) at = journal().find('\n', at) + 1;
    journal()[at + 40] ^= 1;
  }

  std::string refusal(SessionSetup setup) {
    try {
      open(std::move(setup));
    } catch (const IoError& error) {
      return error.what();
    }
    return "";
  }

  Surface surface_ = small_tissue();
  std::shared_ptr<ForgetfulFiles> files_ = std::make_shared<ForgetfulFiles>();
};

void touch_all(Session& session) {
  for (const int stop : session.state().open_stops())
    session.record(felt_at(session.state(), stop));
  session.sync();
}

TEST_F(SessionTest, HandsTheSamePlanOutUntilSomethingHasBecomeOfAllItsStops) {
  Session session = open();
  const std::string first = session.next().plan.waypoints_csv;
  session.record(felt_at(session.state(), 0));
  session.miss(1, "no contact");
  EXPECT_EQ(session.next().plan.waypoints_csv, first);
  EXPECT_EQ(session.state().open_stops(), (std::vector<int>{2, 3}));
  touch_all(session);
  EXPECT_NE(session.next().plan.waypoints_csv, first);
  EXPECT_EQ(session.next().number, 1);
  EXPECT_EQ(session.next().used, "1-4");
}

TEST_F(SessionTest, TakesAReadingOnceThatIsToldTwice) {
  Session session = open();
  session.next();
  const Recorded once = session.record(felt_at(session.state(), 0));
  const Recorded again = session.record(felt_at(session.state(), 0));
  EXPECT_TRUE(once.is_new);
  EXPECT_FALSE(again.is_new);
  EXPECT_EQ(again.number, once.number);
  SessionReading later = felt_at(session.state(), 0);
  later.t_s = 99.0;  // felt again at the same place
  EXPECT_TRUE(session.record(later).is_new);
  EXPECT_EQ(session.state().rows.size(), 2u);
}

TEST_F(SessionTest, GivesAReadingWithoutAStopToTheNearestOpenOneWithinAMillimetre) {
  Session session = open();
  session.next();
  SessionReading near = felt_at(session.state(), 2);
  near.stop.reset();
  near.place += Vec3(0.0, 0.0, -0.002);  // where the tip ended, 2 mm under the tissue
  EXPECT_EQ(session.record(near).stop, 2);
  near.t_s = 5.0;
  EXPECT_EQ(session.record(near).stop, std::nullopt);  // 2 is not open any more
  near.kind = TouchKind::Way;
  near.place = felt_at(session.state(), 1).place;
  EXPECT_EQ(session.record(near).stop, std::nullopt);
}

TEST_F(SessionTest, KeepsWhatLiesOffTheTissueAndInfersNothingFromIt) {
  Session session = open();
  session.next();
  SessionReading off = felt_at(session.state(), 0);
  off.place.z() += 0.02;
  const Recorded recorded = session.record(off);
  EXPECT_FALSE(recorded.off_tissue.empty());
  EXPECT_EQ(session.state().open_stops().size(), 4u);
  EXPECT_EQ(session.state().rows.size(), 1u);
  EXPECT_EQ(measurements_csv(session.state()).find("7."), std::string::npos);
}

TEST_F(SessionTest, RefusesWhatIsNoReadingAndTakesNothing) {
  Session session = open();
  session.next();
  for (const auto& spoil : std::vector<std::function<void(SessionReading&)>>{
           [](SessionReading& one) { one.reading = std::nan(""); },
           [](SessionReading& one) { one.reading = 2e30; },
           [](SessionReading& one) { one.place.x() = INFINITY; },
           [](SessionReading& one) { one.noise_variance = -1.0; },
           [](SessionReading& one) { one.travel = Vec3(1, 1, 0); },
           [](SessionReading& one) { one.t_s = std::nan(""); },
           [](SessionReading& one) { one.stop = 4; },
           [](SessionReading& one) { one.kind = TouchKind::Missed; }}) {
    SessionReading reading = felt_at(session.state(), 0);
    spoil(reading);
    EXPECT_THROW(session.record(reading), InvalidInput);
  }
  EXPECT_THROW(session.miss(-1, ""), InvalidInput);
  EXPECT_THROW(session.withdraw(1, ""), InvalidInput);
  EXPECT_THROW(session.touch_first(Vec3(0, 0, 1)), InvalidInput);
  EXPECT_THROW(session.keep_out({Vec3::Zero(), 0.0}), InvalidInput);
  EXPECT_TRUE(session.state().rows.empty());
}

TEST_F(SessionTest, APersonsHandShowsInTheNextQuestion) {
  Session session = open();
  session.next();
  touch_all(session);
  session.withdraw(2, "slipped, it seems");
  session.touch_first(Vec3(0.010, 0.010, 0.0));
  session.keep_out({Vec3(0.001, 0.001, 0.0), 0.002});
  EXPECT_THROW(session.touch_first(Vec3(0.001, 0.002, 0.0)), InvalidInput);  // kept out
  EXPECT_THROW(session.withdraw(2, "again"), InvalidInput);
  const SessionQuestion question = question_of(session.state());
  EXPECT_NE(question.measurements_csv.find("\"slipped, it seems\""), std::string::npos);
  EXPECT_EQ(question.touch_first.size(), 1u);
  EXPECT_EQ(question.keep_out.size(), 1u);
  const HandedOut& plan = session.next();
  EXPECT_EQ(plan.plan.stops.front(), Vec3(0.010, 0.010, 0.0));
  EXPECT_EQ(plan.used, "1,3-4");
  EXPECT_TRUE(session.state().touch_first.empty());
}

TEST_F(SessionTest, WhatIsKeptOutOfAnOpenPlanIsMissed) {
  Session session = open();
  session.next();
  session.keep_out({session.state().plans.back().plan.stops[1], 1e-6});
  EXPECT_EQ(session.state().plans.back().stops[1], StopState::Missed);
  EXPECT_EQ(session.state().rows.back().why, "kept out");
}

TEST_F(SessionTest, AFinishedPlanStaysUntilSomethingComes) {
  Session session = open(small_setup(surface_, /*plans=*/1));
  session.next();
  touch_all(session);
  EXPECT_EQ(session.next().plan.stop_reason, "budget");
  EXPECT_EQ(session.next().number, 1);
  session.withdraw(1, "");
  EXPECT_EQ(session.next().number, 2);
}

TEST_F(SessionTest, WhatThePlannerThrowsLeavesAllAsItWas) {
  SessionSetup setup = small_setup(surface_);
  setup.planner = [](const SessionQuestion&) -> SessionPlan { throw NumericalError("no field"); };
  Session session = open(setup);
  const std::string before = journal();
  EXPECT_THROW(session.next(), NumericalError);
  EXPECT_EQ(journal(), before);
  EXPECT_TRUE(session.state().plans.empty());
}

TEST_F(SessionTest, ATornLastLineIsDroppedAndTold) {
  {
    Session session = open();
    session.next();
    session.record(felt_at(session.state(), 0));
    session.sync();
  }
  journal() += "0123456789abcdef {\"kind\":\"rea";
  Session session = open();
  ASSERT_EQ(session.remarks().size(), 1u);
  EXPECT_NE(session.remarks()[0].find("cut short"), std::string::npos);
  EXPECT_EQ(session.state().rows.size(), 1u);
  EXPECT_EQ(journal().back(), '\n');
}

TEST_F(SessionTest, ACorruptedLineIsRefusedByItsNumber) {
  {
    Session session = open();
    session.next();
    touch_all(session);
  }
  const std::string sound = journal();
  const auto lines = static_cast<int>(std::ranges::count(sound, '\n'));
  for (int line = 1; line <= lines; ++line) {
    journal() = sound;
    damage(line);
    const std::string words = refusal(small_setup(surface_));
    EXPECT_TRUE(words.starts_with("/run/journal.jsonl:" + std::to_string(line) + ": "))
        << line << ": " << words;
  }
  journal() = sound.substr(0, sound.find('\n') + 1) +
              sound.substr(sound.find('\n', sound.find('\n') + 1) + 1);  // line 2 is taken away
  EXPECT_TRUE(refusal(small_setup(surface_)).starts_with("/run/journal.jsonl:2: "));
  journal() = "my own notes\n";
  EXPECT_NE(refusal(small_setup(surface_)).find("no line of a session's journal"),
            std::string::npos);
  EXPECT_EQ(journal(), "my own notes\n");
}

TEST_F(SessionTest, AHoleInALineThatWasAcknowledgedIsNoTear) {
  {
    Session session = open();
    session.next();
    touch_all(session);
    session.next();  // says that all before was on the disk
  }
  const std::size_t second = journal().find('\n') + 1;
  for (std::size_t i = second; i < second + 60; ++i) journal()[i] = '\0';
  EXPECT_NE(refusal(small_setup(surface_)).find(":2: this line is corrupted: line "),
            std::string::npos);
}

TEST_F(SessionTest, WhatChangedIsToldAndRefusedOnlyWhereThePlanWouldBeAnother) {
  {
    Session session = open();
    session.next();
    session.record(felt_at(session.state(), 0));
    session.sync();
  }
  SessionSetup setup = small_setup(surface_);
  setup.identity.scene = "{\"plan\":{\"batch\":5}}";
  setup.identity.version = "2";
  {
    const Session session = open(setup);  // plans alike
    ASSERT_EQ(session.remarks().size(), 1u);
    EXPECT_NE(session.remarks()[0].find("plan/batch: 4 then, 5 now"), std::string::npos);
    EXPECT_NE(session.remarks()[0].find("the version (1 then, 2 now)"), std::string::npos);
  }
  EXPECT_TRUE(open(setup).remarks().empty());  // told once

  setup.identity.tissue = "another";
  setup.planner = [this](const SessionQuestion& question) {
    SessionPlan plan = small_planner(surface_)(question);
    std::swap(plan.stops.front(), plan.stops.back());
    return plan;
  };
  const std::string before = journal();
  EXPECT_NE(refusal(setup).find("--anyway"), std::string::npos);
  EXPECT_EQ(journal(), before);
  setup.anyway = true;
  Session session = open(setup);
  EXPECT_TRUE(session.state().open_stops().empty());  // what was open belongs to no plan any more
  EXPECT_EQ(session.next().number, 1);
  EXPECT_EQ(session.state().rows.size(), 1u);
}

TEST_F(SessionTest, HasOneWriter) {
  const Session first = open();
  EXPECT_THROW(open(), WriteError);
}

TEST(SessionOnDisk, IsReadWhileItIsWrittenAndAsItWasBeforeAPlan) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "palpation_session/deep/run";
  std::filesystem::remove_all(folder.parent_path().parent_path());
  const Surface surface = small_tissue();
  Session session(folder, small_setup(surface));
  session.next();
  const std::string question = measurements_csv(session.state());
  touch_all(session);
  session.next();
  const SessionState read = read_session(folder);
  EXPECT_EQ(read.rows.size(), 4u);
  EXPECT_EQ(read.plans.size(), 2u);
  EXPECT_EQ(read.plans[1].plan.waypoints_csv, session.state().plans[1].plan.waypoints_csv);
  EXPECT_EQ(measurements_csv(read_session(folder, 0)), question);
  EXPECT_EQ(measurements_csv(read_session(folder, 1)), measurements_csv(session.state()));
  EXPECT_THROW(read_session(folder, 2), IoError);
  EXPECT_THROW(Session(folder, small_setup(surface)), WriteError);  // one writer
  std::filesystem::remove_all(folder.parent_path().parent_path());
}

}  // namespace
}  // namespace palpation
