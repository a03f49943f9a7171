#include "scene/scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "palpation/base/error.h"
#include "scene/scene_schema.h"
#include "scene/setup.h"
#include "scene/speed.h"
#include "scene/tissue.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

TEST(Scene, FillsInTheDefaults) {
  const Scene scene(json::object(), "test", ".");
  EXPECT_EQ(scene.word("plan.acquisition"), "auto");
  EXPECT_EQ(scene.integer("plan.batch"), 10);
  EXPECT_EQ(scene.metres("robot.standoff_mm"), 0.005);
  EXPECT_EQ(scene.word("field.length_mm"), "learn");
  EXPECT_FALSE(scene.has("surface.mesh"));
}

TEST(Scene, TakesOverrides) {
  const std::vector<std::string> overrides{"plan.batch=7", "plan.acquisition=evr",
                                           "level.value=8.5", "surface.mesh=3.ply"};
  const Scene scene = Scene::parse(R"({"plan": {"batch": 5}})", "test", ".", overrides);
  EXPECT_EQ(scene.integer("plan.batch"), 7);
  EXPECT_EQ(scene.word("plan.acquisition"), "evr");
  EXPECT_EQ(scene.number("level.value"), 8.5);
  EXPECT_EQ(scene.word("surface.mesh"), "3.ply");
  EXPECT_EQ(scene.with_overrides(std::vector<std::string>{"plan.batch=8"}).integer("plan.batch"),
            8);
}

TEST(Scene, LosesAKeyThatNullTakesAway) {
  const std::vector<std::string> overrides{"surface.mesh=null", "surface.plane.vertices=[3,3]",
                                           "plan.gamma=null", "plan.batch=null"};
  const Scene scene = Scene::parse(R"({"surface": {"mesh": "a.ply"}, "plan": {"batch": 5}})",
                                   "test", ".", overrides);
  EXPECT_FALSE(scene.gives("surface.mesh"));
  EXPECT_TRUE(scene.gives("surface.plane.vertices"));
  EXPECT_EQ(scene.integer("plan.batch"), 10);
}

TEST(Scene, WarnsOfNothingWhereEverythingHasAnEffect) {
  EXPECT_TRUE(Scene::parse(R"({"level": {"estimate": "known", "value": 8}})", "test", ".")
                  .warnings()
                  .empty());
  EXPECT_TRUE(Scene(json::object(), "test", ".").warnings().empty());
}

TEST(Scene, RefusesSinglePrecisionBeforeATouchWhereItMayNotSuffice) {
  const auto field = [](const std::string& keys) {
    return field_of(Scene::parse(
        R"({"field": {"precision": "single", "length_mm": 3, "signal_sd": 1, )" + keys + "}}",
        "test", "."));
  };
  EXPECT_THROW(field(R"("noise": 0.5)"), IoError) << "beside readings that are not felt yet";
  EXPECT_THROW(field(R"("noise_to_signal": 0.03)"), IoError);
  EXPECT_THROW(field(R"("noise": 0.03, "standardize": false)"), IoError);
  EXPECT_TRUE(field(R"("noise_to_signal": 0.04)").economy.single_precision);
  EXPECT_TRUE(field(R"("noise": 0.04, "standardize": false)").economy.single_precision);
}

TEST(Scene, SpeedStandsForItsPartsWhereTheyAreNotGiven) {
  const Scene draft = Scene::parse(R"({"speed": "draft"})", "test", ".");
  EXPECT_GT(draft.number("plan.explore_mm"), 0.0);
  EXPECT_EQ(draft.word("error.arithmetic"), "plain");
  EXPECT_EQ(draft.complete().at("plan").at("explore_mm"), draft.number("plan.explore_mm"));
  const Scene but_exact =
      Scene::parse(R"({"speed": "draft", "plan": {"explore_mm": 0}})", "test", ".");
  EXPECT_EQ(but_exact.number("plan.explore_mm"), 0.0);
  EXPECT_EQ(but_exact.word("error.arithmetic"), "plain");
  for (const std::string tier : {"exact", "fast", "draft"}) {
    for (const SpeedPart& part : speed_parts(tier))
      EXPECT_NO_THROW(Scene(json::object(), "test", ".").with(part.path, part.value));
  }
  EXPECT_THROW(Scene::parse(R"({"speed": "fastest"})", "test", "."), IoError);
}

TEST(SceneHelp, ExplainsEveryKey) {
  const std::string help = scene_help();
  for (const SceneKey& key : scene_keys())
    EXPECT_NE(help.find(key.path), std::string::npos) << key.path;
  for (const SceneKey& key : scene_keys()) {
    EXPECT_TRUE(key.standard.is_null() || !fault_of(key, key.standard))
        << key.path << ": the default must be allowed";
  }
}

TEST(Setup, RefusesASceneWithoutTissue) {
  EXPECT_THROW(tissue_of(Scene(json::object(), "test", ".")), IoError);
}

TEST(Setup, JoinsTheVerticesOfAMeshOnlyWhereTheSceneSaysSo) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string name = "palpation-seam-" + std::to_string(::getpid()) + ".off";
  // A square of two triangles that share a side, but not its corners.
  std::ofstream(folder / name)
      << "OFF\n6 2 0\n0 0 0\n20 0 0\n20 20 0\n0 0 0\n20 20 0\n0 20 0\n3 0 1 2\n3 3 4 5\n";
  const json given = {{"surface", {{"mesh", name}, {"unit", "mm"}}}};
  const Scene scene(given, "test", folder);
  EXPECT_EQ(tissue_of(scene).surface.vertex_count(), 6);
  const Tissue joined = tissue_of(scene.with("surface.weld", true));
  EXPECT_EQ(joined.surface.vertex_count(), 4);
  ASSERT_EQ(joined.warnings.size(), 1u);
  EXPECT_NE(joined.warnings[0].find("2 vertices were joined"), std::string::npos)
      << joined.warnings[0];
  std::filesystem::remove(folder / name);
}

TEST(Setup, CutsARefinedPatchAtItsRadiusWhateverTheMeshWas) {
  const json given = {{"surface",
                       {{"plane", {{"size_mm", {40, 40}}, {"vertices", {11, 11}}}},
                        {"patch", {{"centre_mm", {20, 20, 0}}, {"radius_mm", 10}}},
                        {"refine_mm", 0.5}}}};
  const Surface patch = tissue_of(Scene(given, "test", ".")).surface;
  const double disk_m2 = std::numbers::pi * 0.010 * 0.010;
  EXPECT_LT(patch.area(), disk_m2);
  EXPECT_GT(patch.area(), 0.94 * disk_m2) << "teeth of half a millimetre, not of four";
  for (int vertex = 0; vertex < patch.vertex_count(); ++vertex)
    EXPECT_LE((patch.vertex(vertex) - Vec3(0.020, 0.020, 0.0)).norm(), 0.010 + 1e-12);
}

TEST(Setup, TakesTheLevelFromWhereTheSceneSays) {
  const auto rule = [](const char* estimate) {
    return model_of(Scene(json{{"level", {{"estimate", estimate}, {"value", 8}}}}, "test", "."))
        .level;
  };
  EXPECT_EQ(rule("range").estimate, LevelEstimate::Range);
  EXPECT_EQ(rule("edge").estimate, LevelEstimate::Edge);
  EXPECT_EQ(rule("known").known, 8.0);
}

TEST(Setup, ReadsThePapersModel) {
  const json given = {
      {"field",
       {{"length_mm", 3.3}, {"signal_sd", 5}, {"noise_to_signal", 0.2}, {"constant_sd", 7.2}}}};
  const FieldModel field = field_of(Scene(given, "test", "."));
  EXPECT_FALSE(field.learns());
  EXPECT_TRUE(field.standardize);
  EXPECT_TRUE(field.noise.is_relative);
  EXPECT_EQ(field.noise.sd, 0.2);
  EXPECT_EQ(field.trend.constant.sd, 7.2);
  EXPECT_EQ(field.economy.reduced_rank_tolerance, 0.0);
}

TEST(Setup, ReducesTheRankWhereThatIsAskedFor) {
  const auto tolerance = [](double given) {
    return field_of(Scene(json{{"field", {{"reduced_rank", given}}}}, "test", "."))
        .economy.reduced_rank_tolerance;
  };
  EXPECT_EQ(tolerance(1e-10), 1e-10);
  EXPECT_EQ(tolerance(0.0), 0.0);
  EXPECT_THROW(tolerance(1e-14), Error);  // less than rounding
  EXPECT_THROW(tolerance(0.1), Error);
}

TEST(Scene, TakesAmericanSpellingsAndAcquisitionsInCapitals) {
  const Scene ours = Scene::parse(
      R"({"surface": {"patch": {"centre_mm": [1, 2, 3], "radius_mm": 9}},
          "plan": {"acquisition": "ils-ucb"},
          "probe": {"tumours": [{"shape": "disk", "centre_mm": [1, 2, 3], "radius_mm": 4}]}})",
      "test", ".");
  const Scene theirs = Scene::parse(
      R"({"surface": {"patch": {"center_mm": [1, 2, 3], "radius_mm": 9}},
          "plan": {"acquisition": "ILS-UCB"},
          "probe": {"tumors": [{"shape": "disk", "center_mm": [1, 2, 3], "radius_mm": 4}]}})",
      "test", ".");
  EXPECT_EQ(ours.complete(), theirs.complete());
  EXPECT_TRUE(theirs.warnings().empty());
}

TEST(Scene, TakesAnOldNameOfAKeyAndSaysTheNewOne) {
  const Scene scene = Scene::parse(R"({"plan": {"assumed_contrast": 2}})", "test", ".");
  EXPECT_EQ(scene.number("plan.min_contrast"), 2.0);
  ASSERT_EQ(scene.warnings().size(), 1u);
  EXPECT_NE(scene.warnings()[0].find("plan.assumed_contrast: is now called plan.min_contrast"),
            std::string::npos);
  EXPECT_EQ(scene.with("seed", 3).warnings(), scene.warnings());
}

TEST(Scene, OverridesAKeyUnderAnyOfItsNames) {
  const auto overridden = [](const std::string& given, const std::string& override) {
    return Scene::parse(given, "test", ".", std::vector<std::string>{override});
  };
  const std::string old_name = R"({"plan": {"assumed_contrast": 2}})",
                    new_name = R"({"plan": {"min_contrast": 2}})";
  for (const std::string& given : {old_name, new_name}) {
    for (const std::string key : {"plan.assumed_contrast", "plan.min_contrast"}) {
      const Scene scene = overridden(given, key + "=3");
      EXPECT_EQ(scene.number("plan.min_contrast"), 3.0) << given << key;
      EXPECT_EQ(scene.warnings().size(), key == "plan.assumed_contrast" ? 1u : 0u) << given << key;
      EXPECT_FALSE(overridden(given, key + "=null").gives("plan.min_contrast")) << given << key;
    }
  }
  EXPECT_EQ(overridden("{}", "plan.acquisition=EVR").word("plan.acquisition"), "evr");
}

TEST(Scene, RefusesAKeyThatIsGivenUnderTwoNames) {
  const std::string twice = R"({"plan": {"assumed_contrast": 2, "min_contrast": 3}})";
  EXPECT_THROW(Scene::parse(twice, "test", "."), IoError);
}

}  // namespace
}  // namespace palpation::tool
