#include "tool/scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "palpation/base/error.h"
#include "tool/scene_schema.h"
#include "tool/setup.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

std::string fault_in(const std::string& text) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "palpation_scene_test.json";
  std::ofstream(path) << text;
  try {
    Scene::read(path, {});
  } catch (const IoError& error) {
    const std::string words = error.what();
    EXPECT_EQ(words.find(path.string()), 0u) << "a message begins with the file: " << words;
    return words.substr(path.string().size());
  }
  return "accepted";
}

TEST(Scene, FillsInTheDefaults) {
  const Scene scene(json::object(), "test", ".");
  EXPECT_EQ(scene.word("plan.acquisition"), "ils-ucb");
  EXPECT_EQ(scene.integer("plan.batch"), 10);
  EXPECT_EQ(scene.metres("robot.standoff_mm"), 0.005);
  EXPECT_EQ(scene.word("field.length_mm"), "learn");
  EXPECT_FALSE(scene.has("surface.mesh"));
}

TEST(Scene, NamesTheNearestKeyForAnUnknownOne) {
  EXPECT_EQ(fault_in(R"({"plan": {"gama": 0.5}})"),
            ": plan.gama: is not a key of a scene; the nearest is plan.gamma (palpate help scene lists all)");
  EXPECT_NE(fault_in(R"({"surfase": {}})").find("surfase"), std::string::npos);
}

TEST(Scene, SaysWhatIsWrongWithAValue) {
  EXPECT_EQ(fault_in(R"({"plan": {"gamma": 1.5}})"), ": plan.gamma: is 1.5, but must be 0 to 1");
  EXPECT_EQ(fault_in(R"({"plan": {"gamma": "0.5"}})"), ": plan.gamma: is \"0.5\", but must be a number");
  EXPECT_EQ(fault_in(R"({"plan": {"batch": 2.5}})"), ": plan.batch: is 2.5, but must be a whole number");
  EXPECT_EQ(fault_in(R"({"plan": {"safe_start": 1}})"), ": plan.safe_start: is 1, but must be true or false");
  EXPECT_EQ(fault_in(R"({"field": {"metric": "straight"}})"), ": field.metric: is \"straight\", but must be one of chart, ambient");
  EXPECT_EQ(fault_in(R"({"field": {"length_mm": "guess"}})"), ": field.length_mm: is \"guess\", but must be a number or learn");
  EXPECT_EQ(fault_in(R"({"field": {"length_mm": -1}})"), ": field.length_mm: is -1, but must be 1e-06 to 1e+06 mm");
  EXPECT_EQ(fault_in(R"({"robot": {"from_tissue": [1, 2]}})"), ": robot.from_tissue: has 2 members, but must have 16");
  EXPECT_EQ(fault_in(R"({"plan": 3})"), ": plan: must be an object");
  EXPECT_EQ(fault_in(R"({"version": 2})"), ": version: is 2, but must be 1 to 1");
}

TEST(Scene, ChecksTumours) {
  EXPECT_EQ(fault_in(R"({"probe": {"tumours": [{"shape": "disc"}]}})"),
            ": probe.tumours: [0].shape is \"disc\", but must be one of disk, horseshoe, polygon");
  EXPECT_EQ(fault_in(R"({"probe": {"tumours": [{"shape": "disk", "centre_mm": [1, 2, 0]}]}})"),
            ": probe.tumours: [0] (disk) lacks radius_mm");
  EXPECT_EQ(fault_in(R"({"probe": {"tumours": [{"shape": "disk", "centre_mm": [1, 2, 0], "radius": 3}]}})"),
            ": probe.tumours: [0].radius is not a key of a disk; the nearest is radius_mm");
}

TEST(Scene, RefusesWhatIsNotJsonWithLineAndColumn) {
  EXPECT_NE(fault_in("{\n  \"seed\": 1,\n}").find("not JSON: parse error at line 3, column 1"), std::string::npos);
  EXPECT_NE(fault_in("").find("not JSON"), std::string::npos);
  EXPECT_NE(fault_in(R"({"seed": 1e999})").find("number"), std::string::npos);
  EXPECT_EQ(fault_in(R"({"seed": 1, "seed": 2})"), ": the key \"seed\" stands twice in one object");
  EXPECT_NE(fault_in(std::string(100000, '[')).find("nested deeper"), std::string::npos);
  EXPECT_NE(fault_in("[1]").find("must be a JSON object"), std::string::npos);
}

TEST(Scene, TakesOverrides) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "palpation_override_test.json";
  std::ofstream(path) << R"({"plan": {"batch": 5}})";
  const std::vector<std::string> overrides{"plan.batch=7", "plan.acquisition=evr", "level.value=8.5"};
  const Scene scene = Scene::read(path, overrides);
  EXPECT_EQ(scene.integer("plan.batch"), 7);
  EXPECT_EQ(scene.word("plan.acquisition"), "evr");
  EXPECT_EQ(scene.number("level.value"), 8.5);
  for (const char* wrong : {"plan.batch", "=3", "plan.bach=3", "plan.batch=many"}) {
    EXPECT_THROW(Scene::read(path, std::vector<std::string>{wrong}), IoError) << wrong;
  }
}

TEST(SceneHelp, ExplainsEveryKey) {
  const std::string help = scene_help();
  for (const SceneKey& key : scene_keys()) EXPECT_NE(help.find(key.path), std::string::npos) << key.path;
  for (const SceneKey& key : scene_keys()) {
    EXPECT_TRUE(key.standard.is_null() || fault_of(key, key.standard).empty()) << key.path << ": the default must be allowed";
  }
}

TEST(Setup, RefusesASceneWithoutTissueOrWithTwo) {
  EXPECT_THROW(tissue_of(Scene(json::object(), "test", ".")), IoError);
  const json both = {{"surface", {{"mesh", "a.ply"}, {"unit", "mm"}, {"plane", {{"size_mm", {10, 10}}}}}}};
  EXPECT_THROW(tissue_of(Scene(both, "test", ".")), IoError);
}

TEST(Setup, ReadsThePapersModel) {
  const json given = {{"field", {{"length_mm", 3.3}, {"signal_sd", 5}, {"noise_to_signal", 0.2}, {"constant_sd", 7.2}}}};
  const FieldModel field = field_of(Scene(given, "test", "."));
  EXPECT_FALSE(field.learns());
  EXPECT_TRUE(field.belief.standardize);
  EXPECT_TRUE(field.belief.noise_is_relative);
  EXPECT_EQ(field.belief.noise_sd, 0.2);
  EXPECT_EQ(field.constant.sd, 7.2);
}

}  // namespace
}  // namespace palpation::tool
