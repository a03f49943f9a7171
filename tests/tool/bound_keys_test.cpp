// A default stands in one place, at the member that a key sets.
#include "scene/bound_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <type_traits>

#include "scene/scene_schema.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

const SceneKey& row_of(const std::string& path) {
  return *std::ranges::find(scene_keys(), path, &SceneKey::path);
}

/// A scene z-scores readings, as the paper's code does; a model in C++ says so itself.
bool is_the_scenes_own(const std::string& path) { return path == "field.standardize"; }

/// Calls a function with each list of keys, and what a scene that says nothing makes of it.
template <typename Visit>
void for_all_options(const Visit& visit) {
  const Scene scene(json::object(), "test", ".");
  visit(field_keys(), field_of(scene));
  visit(model_keys(), model_of(scene));
  visit(plan_keys(), plan_of(scene));
  visit(robot_keys(), robot_of(scene));
  visit(access_keys(), access_of(scene));
  visit(limit_keys(), bound(scene, limit_keys()));
  visit(stiffness_keys(), bound(scene, stiffness_keys()));
}

/// Allowed, and not what is there now.
json another_value(const SceneKey& row, const json& now) {
  if (row.path == "level.estimate") return "range";  // known needs level.value
  if (row.kind == ValueKind::Word) return row.words[row.words.front() == now ? 1 : 0];
  if (row.kind == ValueKind::Truth) return !now.get<bool>();
  if (row.kind == ValueKind::Text) return "any";
  if (row.kind == ValueKind::Integer) return 17;
  if (row.kind != ValueKind::Numbers) return row.least + (row.most - row.least) / 8.0;
  json list = json::array();
  for (int i = 0; i < row.count; ++i) list.push_back(i);
  return list;
}

TEST(BoundKeys, HelpSaysWhatAMemberHoldsByDefault) {
  for_all_options([](const auto& keys, const auto& of_scene) {
    const std::remove_cvref_t<decltype(of_scene)> by_default{};
    for (const auto& key : keys) {
      if (is_the_scenes_own(key.path)) continue;
      const json standard = key.told(by_default);
      EXPECT_EQ(key.told(of_scene), standard) << key.path << " of a scene that says nothing";
      EXPECT_EQ(row_of(key.path).standard, standard) << key.path;
      if (!standard.is_null()) {
        EXPECT_NE(key_help(key.path).find("; default " + standard.dump()), std::string::npos)
            << key_help(key.path);
      }
    }
  });
}

TEST(BoundKeys, AMemberTellsWhatItsKeyWasSetTo) {
  for_all_options([](const auto& keys, const auto& of_scene) {
    for (const auto& key : keys) {
      std::remove_cvref_t<decltype(of_scene)> options{};
      const json value = another_value(row_of(key.path), key.told(options));
      ASSERT_NE(value, key.told(options)) << key.path << ": this shows nothing";
      key.set(options, value);
      const json told = key.told(options);
      if (value.is_number_float()) {
        EXPECT_NEAR(told.get<double>(), value.get<double>(), 1e-11 * std::abs(value.get<double>()))
            << key.path;
      } else {
        EXPECT_EQ(told, value) << key.path;
      }
    }
  });
}

TEST(BoundKeys, WhatElseHasADefaultSetsNoSingleMember) {
  std::set<std::string> others;
  for (const SceneKey& row : scene_keys()) {
    if (!row.standard.is_null() && !from_member(row.path)) others.insert(row.path);
  }
  const std::set<std::string> known = {"version",
                                       "certainty",
                                       "speed",
                                       "seed",
                                       "surface.off_tissue",
                                       "surface.weld",
                                       "surface.plane.vertices",
                                       "surface.patch.within_deg",  // which tissue
                                       "field.heavy_tails",         // does nothing
                                       "plan.acquisition",
                                       "plan.gamma",
                                       "plan.scaling",
                                       "plan.row_spacing_mm",  // a function's
                                       "plan.explore_mm",
                                       "plan.touch_first_mm",
                                       "plan.keep_out_mm",
                                       "robot.margin_mm",
                                       "robot.place_uncertainty_mm",
                                       "probe.kind",
                                       "probe.tumours",
                                       "band.probability",
                                       "band.cut_risk",
                                       "error.arithmetic"};
  for (const std::string& path : others)
    EXPECT_TRUE(known.contains(path)) << path << ": bind it to a member (scene/bound_keys.h)";
}

TEST(BoundKeys, WordsAndRangesHoldTheDefault) {
  for (const SceneKey& row : scene_keys()) {
    if (!row.standard.is_null()) {
      EXPECT_FALSE(fault_of(row, row.standard)) << row.path;
    }
    EXPECT_TRUE(row.kind != ValueKind::Word || !row.words.empty()) << row.path;
  }
}

}  // namespace
}  // namespace palpation::tool
