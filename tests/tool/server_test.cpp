// What `palpate serve` answers, line by line: a touch from the plan to the reading, and whatever
// else a caller may send.
#include "tool/server.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "palpation/session/session_state.h"
#include "tool/serve_lines.h"

namespace palpation::tool {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const char* const kScene = R"({
  "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}},
  "certainty": "laplace",
  "plan": {"initial": {"count": 9}, "batch": 4, "batches": 2},
  "robot": {"frame": "PSM1_base"}})";

class ServerTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("palpation_serve_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "scene.json") << kScene;
  }
  void TearDown() override { fs::remove_all(folder_); }

  json ask(const json& request) {
    json answer = json::parse(server_.answer(request.dump()));
    server_.sync();
    return answer;
  }
  json done(const json& request) {
    json answer = ask(request);
    EXPECT_EQ(answer["ok"], true) << request << " " << answer;
    return answer;
  }
  std::string refused(const json& request) {
    const json answer = ask(request);
    EXPECT_EQ(answer["ok"], false) << request << " " << answer;
    return answer.value("error", "");
  }
  void open() {
    done({{"do", "open"}, {"scene", folder_ / "scene.json"}, {"folder", folder_ / "run"}});
  }

  fs::path folder_;
  Server server_{""};
};

json felt(const json& stop, double reading) {
  return {
      {"do", "record"}, {"place", stop["place"]}, {"reading", reading}, {"stop", stop["index"]}};
}

TEST_F(ServerTest, AsksAndTellsUntilThePlanIsDone) {
  open();
  int readings = 0;
  for (int plan = 0; plan < 3; ++plan) {
    const json next = done({{"do", "next"}, {"id", plan}});
    EXPECT_EQ(next["id"], plan);
    EXPECT_EQ(next["plan"], plan);
    for (const json& stop : next["stops"]) {
      const double x = stop["place"][0], y = stop["place"][1];
      const bool is_stiff = std::hypot(x - 0.01, y - 0.01) < 0.005;
      ++readings;
      EXPECT_EQ(done(felt(stop, (is_stiff ? 9.0 : 7.0) + 0.01 * (readings % 5)))["number"],
                readings);
    }
  }
  EXPECT_EQ(done({{"do", "next"}})["finished"], "budget");
  const json summary = done({{"do", "conclude"}})["summary"];
  EXPECT_EQ(summary["measurements"], readings);
  done({{"do", "close"}});
  EXPECT_EQ(read_session(folder_ / "run").rows.size(), static_cast<std::size_t>(readings));
}

TEST_F(ServerTest, RefusesInWordsWhatItCannotDo) {
  EXPECT_NE(refused({{"do", "next"}}).find("no session is open"), std::string::npos);
  EXPECT_NE(refused({{"do", "open"}, {"scene", "nowhere.json"}, {"folder", folder_ / "run"}})
                .find("nowhere.json"),
            std::string::npos);
  EXPECT_NE(refused({{"do", "dance"}}).find("must be open, next"), std::string::npos);
  open();
  EXPECT_NE(refused({{"do", "open"}, {"scene", "s"}, {"folder", "f"}}).find("already"),
            std::string::npos);
  const json stop = done({{"do", "next"}})["stops"][0];
  json request = felt(stop, 7.0);
  request["place"] = {1, 2};
  EXPECT_NE(refused(request).find("\"place\" is [1,2], but must be a list of 3 numbers"),
            std::string::npos);
  request = felt(stop, 7.0);
  request["raeding"] = 1;
  EXPECT_NE(refused(request).find("\"raeding\" means nothing here"), std::string::npos);
  request = felt(stop, 7.0);
  request["stop"] = 99;
  EXPECT_NE(refused(request).find("must be one of the plan's 9"), std::string::npos);
  EXPECT_EQ(json::parse(server_.answer("{\"do\": \"next\""))["ok"], false);
  EXPECT_EQ(json::parse(server_.answer("[]"))["ok"], false);
  EXPECT_EQ(done({{"do", "show"}})["rows"], 0);
}

TEST_F(ServerTest, SaysTheWayBetweenStopsAndTheGatesLimits) {
  open();
  const json next = done({{"do", "next"}});
  ASSERT_FALSE(next["way"].empty());
  double leg = next["way"][0]["leg"];
  for (const json& place : next["way"]) {
    EXPECT_GE(place["leg"], leg);
    leg = place["leg"];
    EXPECT_DOUBLE_EQ(place["approach_z"], 0.005);
  }
  EXPECT_LT(leg, static_cast<double>(next["stops"].size()));
  const json limits = done({{"do", "gate"}, {"what", "limits"}});
  EXPECT_EQ(limits["frame"], "PSM1_base");
  EXPECT_DOUBLE_EQ(limits["box_most"][2], 0.027);  // 20 mm, and the way in and out
  EXPECT_DOUBLE_EQ(limits["hold_n"], 5.0);
}

TEST_F(ServerTest, ItsGateLetsATouchBeginAndHoldsUntilItIsAcknowledged) {
  open();
  const json stop = done({{"do", "next"}})["stops"][4];
  double now = 10.0;
  const auto gate = [&](json request) {
    request["do"] = "gate";
    request["now"] = now;
    return done(request);
  };
  const auto hear = [&](double above) {
    now += 0.01;
    const json position = {stop["x"], stop["y"], stop["z"].get<double>() + above};
    gate({{"what", "pose"},
          {"stamp", now},
          {"frame", "PSM1_base"},
          {"position", position},
          {"quaternion", {1, 0, 0, 0}}});
    gate({{"what", "force"}, {"stamp", now}, {"force", 0.0}});
    gate({{"what", "state"}, {"stamp", now}, {"state", "ENABLED"}, {"is_homed", true}});
    return position;
  };
  hear(0.005);
  EXPECT_EQ(gate({{"what", "begin"}, {"stop", 4}})["answer"], "go");
  json position = hear(0.005);
  json set_point{{"what", "permit"},
                 {"phase", "air"},
                 {"frame", "PSM1_base"},
                 {"position", position},
                 {"quaternion", {1, 0, 0, 0}}};
  EXPECT_EQ(gate(set_point)["answer"], "go");
  set_point["position"][0] = position[0].get<double>() + 0.01;
  now += 0.01;
  const json held = gate(set_point);
  EXPECT_EQ(held["answer"], "hold");
  EXPECT_EQ(held["words"], "a step of 10 mm, more than 1 mm");
  set_point["position"] = position;
  EXPECT_EQ(gate(set_point)["answer"], "hold");
  hear(0.005);
  EXPECT_EQ(done({{"do", "acknowledge"}, {"now", now}})["answer"], "go");
  EXPECT_EQ(gate({{"what", "begin"}, {"stop", 4}})["answer"], "go");
}

TEST_F(ServerTest, WhatItsGateHeldForIsHeldForUntilItIsAcknowledgedInTheNextSession) {
  open();
  done({{"do", "gate"}, {"what", "failure"}, {"words", "a joint jumped"}, {"now", 1.0}});
  done({{"do", "close"}});
  open();
  const auto stop = done({{"do", "next"}})["stops"][0]["index"];
  const json begun = done({{"do", "gate"}, {"what", "begin"}, {"stop", stop}, {"now", 2.0}});
  EXPECT_EQ(begun["answer"], "hold") << begun;
  EXPECT_NE(begun.dump().find("a joint jumped"), std::string::npos) << begun;
}

TEST_F(ServerTest, PlansNoStopWhereAPersonSaidToKeepOut) {
  std::ofstream(folder_ / "scene.json") << R"({
    "surface": {"plane": {"size_mm": [20, 20], "vertices": [14, 14]}}, "certainty": "laplace",
    "plan": {"initial": {"count": 9}, "batch": 4, "batches": 2, "keep_out_mm": [[10, 10, 0, 3]]},
    "robot": {"frame": "PSM1_base"}})";
  open();
  done({{"do", "touch"}, {"place", {0.01, 0.01, 0.0}}});    // within the scene's ball
  done({{"do", "touch"}, {"place", {0.004, 0.004, 0.0}}});  // within no ball
  const json stops = done({{"do", "next"}})["stops"];
  ASSERT_FALSE(stops.empty());
  bool is_wish_kept = false;
  for (const json& stop : stops) {
    const double x = stop["place"][0], y = stop["place"][1];
    EXPECT_GT(std::hypot(x - 0.01, y - 0.01), 0.003) << stop;
    is_wish_kept = is_wish_kept || std::hypot(x - 0.004, y - 0.004) < 0.0015;
  }
  EXPECT_TRUE(is_wish_kept);
}

TEST_F(ServerTest, WhateverLineComesIsAnsweredInWords) {
  const std::string scene =
      json{{"do", "open"}, {"scene", folder_ / "scene.json"}, {"folder", folder_ / "run"}}.dump();
  Random random(11);
  int done = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string line = random_line(random, scene);
    const json answer = json::parse(server_.answer(line));
    ASSERT_TRUE(answer.contains("ok")) << line;
    if (answer["ok"] == true) {
      ++done;
    } else {
      ++refused;
      ASSERT_GT(answer.value("error", "").size(), 5u) << line;
    }
    if (i % 500 == 0) server_.sync();
  }
  server_.sync();
  EXPECT_GT(done, 2'000);
  EXPECT_GT(refused, 5'000);
  EXPECT_GT(read_session(folder_ / "run").rows.size(), 15u);  // told again, they are known
}

}  // namespace
}  // namespace palpation::tool
