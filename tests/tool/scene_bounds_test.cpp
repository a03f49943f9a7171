// The whole table of keys: every number has bounds, they are kept, and scenes at the bounds run or
// are refused in words.
#include <gtest/gtest.h>

#include <cmath>

#include "palpation/base/error.h"
#include "scene/episode.h"
#include "scene/exit_code.h"
#include "scene/scene_schema.h"
#include "scene/tissue.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

bool is_number(const SceneKey& key) {
  return key.kind == ValueKind::Number || key.kind == ValueKind::Integer ||
         key.kind == ValueKind::NumberOrWord;
}

bool is_list(const SceneKey& key) {
  return key.kind == ValueKind::Numbers || key.kind == ValueKind::Integers;
}

/// A value for a key: the number itself, or a list of it.
json value_for(const SceneKey& key, double number) {
  if (is_number(key)) return number;
  return std::vector<double>(static_cast<std::size_t>(key.count), number);
}

json object_with(const std::string& path, const json& value) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return {{path, value}};
  return {{path.substr(0, dot), object_with(path.substr(dot + 1), value)}};
}

/// A small scene in which the key has an effect, where there is such.
json small_scene(const std::string& path) {
  json scene = {
      {"plan", {{"initial", {{"count", 4}}}, {"batch", 2}, {"batches", 1}}},
      {"probe",
       {{"noise", 0.05},
        {"tumours", {{{"shape", "disk"}, {"centre_mm", {10, 10, 0}}, {"radius_mm", 5}}}}}},
      {"surface", {{"plane", {{"size_mm", {20, 20}}, {"vertices", {6, 6}}}}}}};
  if (path == "field.period_mm") scene["field"]["kernel"] = "periodic";
  if (path == "field.noise_to_signal") scene["field"] = {{"length_mm", 3}, {"signal_sd", 1}};
  if (path == "field.noise") scene["field"] = {{"length_mm", 3}, {"signal_sd", 1}};
  if (path == "level.value") scene["level"]["estimate"] = "known";
  if (path == "plan.row_spacing_mm") scene["plan"]["acquisition"] = "raster";
  if (path == "surface.patch.radius_mm") scene["surface"]["patch"]["centre_mm"] = {10, 10, 0};
  if (path == "surface.patch.centre_mm") scene["surface"]["patch"]["radius_mm"] = 9;
  return scene;
}

json with(const SceneKey& key, double number) {
  json scene = small_scene(key.path);
  scene.merge_patch(object_with(key.path, value_for(key, number)));
  return scene;
}

std::string error_of(const json& given) {
  try {
    Scene(given, "test", ".");
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneBounds, EveryNumberHasSome) {
  for (const SceneKey& key : scene_keys()) {
    if (!is_number(key) && !is_list(key)) continue;
    EXPECT_LE(key.least, key.most) << key.path;
    EXPECT_GE(key.least, -1e30) << key.path;
    EXPECT_LE(key.most, 1e30) << key.path;
    EXPECT_TRUE(key.least <= 0.0 || key.least >= 1e-30)
        << key.path << ": its square must be a number";
  }
}

TEST(SceneBounds, WhatIsBeyondIsRefusedByNameValueAndRange) {
  for (const SceneKey& key : scene_keys()) {
    if (!is_number(key) && !is_list(key)) continue;
    for (const double beyond :
         {-1e300, 1e300, -5e-324, 5e-324, -1.0, std::nextafter(key.least, -1e300),
          std::nextafter(key.most, 1e300)}) {
      if (beyond >= key.least && beyond <= key.most) continue;
      const std::string error = error_of(with(key, beyond));
      EXPECT_EQ(error.rfind("test: " + key.path, 0), 0u)
          << key.path << " = " << beyond << ": " << error;
      EXPECT_NE(error.find("is "), std::string::npos) << error;
    }
  }
}

/// Runs a scene; a refusal is fine if it is in words of the scene.
void expect_sound(const std::string& name, const json& given) {
  try {
    const Scene scene(given, "test", ".");
    const Tissue tissue = tissue_of(scene);
    const Episode episode =
        run_episode(scene, tissue.surface, simulated_world(scene, tissue.surface));
    const Marginals& marginals = episode.conclusion().marginals;
    EXPECT_TRUE(marginals.mean.allFinite() && marginals.variance.allFinite()) << name;
    EXPECT_GE(marginals.variance.minCoeff(), 0.0) << name;
    EXPECT_LE(episode.estimate.area(), tissue.surface.area() * (1.0 + 1e-12)) << name;
    EXPECT_TRUE(!episode.error || std::isfinite(episode.error->symmetric_difference_m2)) << name;
  } catch (const std::exception& error) {
    EXPECT_EQ(exit_code_of(error), kInputAtFault) << name << ": " << error.what();
    EXPECT_EQ(std::string(error.what()).rfind("test: ", 0), 0u) << name << ": " << error.what();
  }
}

TEST(SceneBounds, ScenesAtTheBoundsRunOrAreRefusedInWords) {
  for (const SceneKey& key : scene_keys()) {
    if (!is_number(key) && !is_list(key)) continue;
    for (const double number :
         {key.least, key.most, 0.0, std::sqrt(std::abs(key.least * key.most))}) {
      if (number < key.least && !(key.zero_too && number == 0.0)) continue;
      if (key.path == "plan.batches" && number > 100)
        continue;  // as many as are asked for: nothing to see here
      json given = with(key, key.kind == ValueKind::Integer || key.kind == ValueKind::Integers
                                 ? std::floor(number)
                                 : number);
      expect_sound(key.path + " = " + text_of(number), given);
    }
  }
}

TEST(SceneBounds, TumoursAtTheBoundsRunOrAreRefusedInWords) {
  const json disk = {{"shape", "disk"}, {"centre_mm", {10, 10, 0}}, {"radius_mm", 5}};
  const json horseshoe = {{"shape", "horseshoe"},
                          {"centre_mm", {10, 10, 0}},
                          {"arc_radius_mm", 5},
                          {"half_width_mm", 2}};
  const json polygon = {{"shape", "polygon"}, {"points_mm", {{5, 5, 0}, {15, 5, 0}, {15, 15, 0}}}};
  for (const json& shape : {disk, horseshoe, polygon}) {
    for (const SceneKey& key : tumour_keys(shape["shape"])) {
      for (const double number : {key.least, key.most, 0.0, -1.0, 1e-300, 1e300, 5e-324}) {
        json changed = shape;
        if (key.kind == ValueKind::Points) {
          changed["points_mm"][1][0] = number;
        } else {
          changed[key.path] = value_for(key, number);
        }
        json given = small_scene("");
        given["probe"]["tumours"] = {changed};
        expect_sound(key.path + " = " + text_of(number), given);
      }
    }
  }
}

}  // namespace
}  // namespace palpation::tool
