// What `palpate boundary` and `palpate plan` make of measurements.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "palpation/io/measurements.h"
#include "scene/episode.h"
#include "scene/tissue.h"
#include "scene/words.h"
#include "tool/commands.h"

namespace palpation::tool {
namespace {

constexpr const char* kScene =
    R"({"surface": {"plane": {"size_mm": [20, 20], "vertices": [11, 11]}}, "plan": {"batch": 3, "initial": {"count": 5}}, "certainty": "laplace"})";

/// Writes scene and measurements, and is gone with them.
class Files {
 public:
  explicit Files(const std::string& csv)
      : stem_((std::filesystem::temp_directory_path() /
               ("palpation-measured-" + std::to_string(::getpid())))
                  .string()) {
    std::ofstream(scene()) << kScene;
    std::ofstream(measurements()) << csv;
  }
  ~Files() {
    std::filesystem::remove(scene());
    std::filesystem::remove(measurements());
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  std::filesystem::path scene() const { return stem_ + ".json"; }
  std::filesystem::path measurements() const { return stem_ + ".csv"; }

 private:
  std::string stem_;
};

Episode bounded(const std::string& csv, const std::vector<std::string>& overrides = {}) {
  const Files files(csv);
  const Scene scene = Scene::read(files.scene(), overrides);
  const Tissue tissue = tissue_of(scene);
  return episode_from(scene, tissue.surface,
                      read_measurements(files.measurements(), tissue.surface).palpations);
}

/// What the command says against the measurements; empty if nothing.
std::string error_of(const std::string& csv, const std::vector<std::string>& overrides = {}) {
  const Files files(csv);
  try {
    boundary({.scene = files.scene(), .overrides = overrides, .seed = {}, .out = {}, .quiet = true},
             files.measurements());
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

/// Readings on a grid: 7, and 9 inside a disk of 5 mm about the middle, changed by a function.
template <typename Change>
std::string grid(const Change& change) {
  std::string csv = "x,y,z,reading\n";
  for (int i = 0; i < 64; ++i) {
    const double x = 0.00125 + 0.0025 * (i % 8), y = 0.00125 + 0.0025 * (i / 8);
    const double reading =
        7.0 + 2.0 / (1.0 + std::exp(-1400.0 * (0.005 - std::hypot(x - 0.01, y - 0.01))));
    csv += text_of(x) + "," + text_of(y) + ",0," + text_of(change(reading)) + "\n";
  }
  return csv;
}

TEST(Measured, S03ContradictionsAreNamedWhereTheFieldHasNoNoise) {
  const std::string csv = "x,y,z,reading\n0.01,0.01,0,7\n0.002,0.01,0,7\n0.01,0.01,0,8\n";
  EXPECT_EQ(error_of(csv), "");
  const std::string error =
      error_of(csv, {"field.noise=0", "field.length_mm=3", "field.signal_sd=1"});
  EXPECT_NE(error.find(".csv:4: the reading 8 contradicts 7 in line 2"), std::string::npos)
      << error;
}

TEST(Measured, S10ReadingsThatAreAllAlikeHoldNoTumour) {
  for (const double reading : {7.0, 0.0, -3.0, 1e9, 1e-300}) {
    for (const std::vector<std::string>& overrides :
         {std::vector<std::string>{},
          {"plan.safe_start=false"},
          {"field.length_mm=3", "field.signal_sd=1", "field.noise=0.1"},
          {"field.trend=zero"}}) {
      const Episode episode = bounded(grid([&](double) { return reading; }), overrides);
      EXPECT_FALSE(episode.conclusion().level.has_value()) << reading;
      EXPECT_TRUE(episode.estimate.empty()) << reading;
      EXPECT_NE(episode_words(episode).find("Nothing found"), std::string::npos);
      EXPECT_FALSE(episode.exploration.next().empty()) << "there is more to touch";
    }
  }
}

TEST(Measured, S10AKnownLevelParts) {
  const std::vector<std::string> known = {"level.estimate=known", "level.value=8"};
  EXPECT_TRUE(bounded(grid([](double) { return 7.0; }), known).estimate.empty());
  EXPECT_NEAR(bounded(grid([](double) { return 9.0; }), known).estimate.area(), 4e-4,
              1e-12);  // the whole tissue
}

TEST(Measured, S10NoiseThatDrownsEverythingLeavesNoLevel) {
  const Episode episode = bounded(grid([](double reading) { return reading; }),
                                  {"field.noise=1e30", "field.length_mm=3", "field.signal_sd=1"});
  EXPECT_TRUE(episode.estimate.empty());
  EXPECT_NEAR(episode.conclusion().marginals.variance.maxCoeff(),
              episode.conclusion().marginals.variance.minCoeff(), 1e-9);
}

/// The area found in the grid's readings, each changed alike. They scatter by a fortieth of their
/// range: draws of exact ones take ten times as long to agree.
double area_found(double (*change)(double), const std::string& certainty) {
  Random random(1);
  return bounded(grid([&](double reading) { return change(reading + 0.05 * random.normal()); }),
                 {"certainty=" + certainty})
      .estimate.area();
}

// The area is that of the same readings without an offset, but for what learning leaves open (1e-5
// of each hyperparameter).
TEST(Measured, S12TheBoundaryDoesNotDependOnUnitAndOrigin) {
  // Draws that round differently are other draws of the same outlines: two hundred tell the area to
  // a hundredth.
  for (const auto& [certainty, part] : {std::pair("laplace", 1e-4), std::pair("sampled", 2e-2)}) {
    const double area = area_found([](double reading) { return reading; }, certainty);
    // A disk of 5 mm, from a level that the range of the mean misses by a little.
    EXPECT_NEAR(area, 7.85e-5, 2e-5);
    for (double (*change)(double) : {+[](double reading) { return reading + 1e9; },
                                     +[](double reading) { return reading * 1e20; },
                                     +[](double reading) { return reading * 1e-20; },
                                     +[](double reading) { return reading - 100.0; }})
      EXPECT_NEAR(area_found(change, certainty), area, part * area) << certainty;
  }
}

TEST(Measured, S19NothingMeasuredIsTheInitialDesignAndNoBoundary) {
  const Episode episode = bounded("x,y,z,reading\n");
  EXPECT_TRUE(episode.estimate.empty());
  EXPECT_EQ(episode_words(episode), "0 readings.\nNo readings yet, so nothing is known.\n");
  EXPECT_EQ(episode.exploration.next().size(), 5u);
}

TEST(Measured, OneReadingIsNoTumour) {
  const Episode episode = bounded("x,y,z,reading\n0.01,0.01,0,7\n",
                                  {"field.length_mm=3", "field.signal_sd=1", "field.noise=0.1"});
  EXPECT_TRUE(episode.estimate.empty());
}

TEST(Measured, AFieldThatCannotBeFittedIsToldWithWhatHelps) {
  try {
    bounded(grid([](double reading) { return reading; }),
            {"field.noise=0", "field.length_mm=100", "field.signal_sd=1"});
    ADD_FAILURE()
        << "64 exact readings 2.5 mm apart determine no field of 100 mm in double precision";
  } catch (const NumericalError& error) {
    EXPECT_NE(
        std::string(error.what()).find(".json: field: cannot be fitted to the readings: site "),
        std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("What helps: field.noise above 0"), std::string::npos)
        << error.what();
  }
}

TEST(Measured, MorePlacesThanCanBeModelledAreRefused) {
  std::string csv = "x,y,z,reading\n";
  for (int i = 0; i < 10001; ++i)
    csv += text_of(0.0001 * (i % 200)) + "," + text_of(0.0001 * (i / 200)) + ",0,7\n";
  const std::string error = error_of(csv);
  EXPECT_NE(error.find(".csv: readings at 10001 places; at most 10000 can be modelled"),
            std::string::npos)
      << error;
}

}  // namespace
}  // namespace palpation::tool
