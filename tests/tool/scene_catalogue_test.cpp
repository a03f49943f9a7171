// Every scene of the catalogue, through the code that `palpate simulate` runs.
#include "tool/scene_catalogue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/episode.h"
#include "scene/exit_code.h"
#include "scene/tissue.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using catalogue::SceneCase;

/// A folder with the files that the scenes name, and the scene itself.
class SceneFolder {
 public:
  SceneFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("palpation-scenes-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    for (const catalogue::SceneFile& file : catalogue::scene_files())
      std::ofstream(path_ / file.name) << file.content;
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::filesystem::path scene(const std::string& text) const {
    std::ofstream(path_ / "scene.json", std::ios::binary) << text;
    return path_ / "scene.json";
  }

 private:
  std::filesystem::path path_;
};

struct Outcome {
  ExitCode code = kDone;
  std::string error;
  std::vector<std::string> warnings;
};

/// What `palpate simulate` does, but for the printing.
Outcome simulated(const SceneFolder& folder, const SceneCase& one) {
  Outcome outcome;
  const std::filesystem::path path = folder.scene(one.text);
  try {
    const Scene scene = Scene::read(path, one.overrides);
    const Tissue tissue = tissue_of(scene);
    const World world = simulated_world(scene, tissue.surface);
    const Episode episode = run_episode(scene, tissue.surface, world);
    outcome.warnings = tissue.warnings;
    outcome.warnings.insert(outcome.warnings.end(), world.warnings.begin(), world.warnings.end());
    EXPECT_TRUE(episode.conclusion().marginals.mean.allFinite()) << one.name;
    EXPECT_TRUE(episode.conclusion().marginals.variance.allFinite()) << one.name;
    EXPECT_GE(episode.conclusion().marginals.variance.minCoeff(), 0.0) << one.name;
    EXPECT_LE(episode.estimate.area(), tissue.surface.area() * (1.0 + 1e-12)) << one.name;
  } catch (const std::exception& error) {
    outcome.code = exit_code_of(error);
    outcome.error = error.what();
  }
  return outcome;
}

void expect_refused(const SceneCase& one, const Outcome& outcome) {
  EXPECT_EQ(outcome.code, kInputAtFault) << one.row << " " << one.name << ": " << outcome.error;
  EXPECT_LT(outcome.error.size(), 700u) << "an error is a sentence: " << one.name;
  for (const std::string& words : one.refused_with) {
    EXPECT_NE(outcome.error.find(words), std::string::npos)
        << one.row << " " << one.name << ": " << outcome.error << "\nlacks: " << words;
  }
}

void expect_done(const SceneCase& one, const Outcome& outcome) {
  EXPECT_EQ(outcome.code, kDone) << one.row << " " << one.name << ": " << outcome.error;
  for (const std::string& words : one.warned_with) {
    const auto says = [&](const std::string& warning) {
      return warning.find(words) != std::string::npos;
    };
    EXPECT_TRUE(std::any_of(outcome.warnings.begin(), outcome.warnings.end(), says))
        << one.row << " " << one.name << " lacks: " << words;
  }
}

TEST(SceneCatalogue, EverySceneEndsAsItsRowSays) {
  const SceneFolder folder;
  for (const SceneCase& one : catalogue::scene_cases()) {
    const Outcome outcome = simulated(folder, one);
    if (one.refused_with.empty()) {
      expect_done(one, outcome);
    } else {
      expect_refused(one, outcome);
    }
  }
}

TEST(SceneCatalogue, HasEveryRow) {
  std::set<std::string> rows;
  for (const SceneCase& one : catalogue::scene_cases()) rows.insert(one.row);
  for (const catalogue::RowElsewhere& row : catalogue::scene_rows_elsewhere()) rows.insert(row.row);
  for (int number = 1; number <= 19; ++number)
    EXPECT_TRUE(rows.contains((number < 10 ? "C0" : "C") + std::to_string(number))) << number;
}

TEST(SceneCatalogue, EveryTruncationOfAnExampleIsRefusedWithItsPlace) {
  for (const char* name : {"planar", "horseshoe", "two_tumours"}) {
    const std::string whole =
        read_file(std::string(PALPATION_SOURCE_DIR "/examples/") + name + ".json");
    const std::size_t end = whole.find_last_of('}');
    for (std::size_t size = 0; size <= end; ++size) {
      try {
        Scene::parse(std::string_view(whole).substr(0, size), "s.json", ".");
        ADD_FAILURE() << name << " cut after byte " << size << " was accepted";
      } catch (const IoError& error) {
        const std::string words = error.what();
        EXPECT_TRUE(
            words.find(": not JSON: ") != std::string::npos ||
            words == "s.json: is empty; a scene is a JSON object, such as { \"version\": 1, ... }")
            << words;
      }
    }
    EXPECT_NO_THROW(Scene::parse(whole, "s.json", "."));
  }
}

TEST(SceneCatalogue, AnExampleWithOneByteChangedIsReadOrRefused) {
  const std::string whole = read_file(PALPATION_SOURCE_DIR "/examples/planar.json");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char byte : {'\0', '"', '{', '9', '-', '\xff'}) {
      std::string changed = whole;
      changed[at] = byte;
      try {
        Scene::parse(changed, "s.json", ".");
      } catch (const IoError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("s.json:", 0), 0u) << error.what();
      }
    }
  }
}

TEST(SceneCatalogue, RefusesAHundredMegabytesUnread) {
  const SceneFolder folder;
  const std::filesystem::path path = folder.scene("{\"seed\": \"");
  std::filesystem::resize_file(path, 100u << 20);
  try {
    Scene::read(path, {});
    ADD_FAILURE() << "accepted";
  } catch (const IoError& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("scene.json: cannot read: 104857600 bytes are more than the limit of 16777216"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace palpation::tool
