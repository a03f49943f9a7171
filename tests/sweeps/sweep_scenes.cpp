// COUNT random scenes with values anywhere in the ranges of the schema, its bounds above all, run
// from beginning to end; every second one from random measurements instead. Each is done with an
// answer that is finite, or refused as an input at fault, or fails in the arithmetic and says so.
// Ends with 1, and the scene, where one does something else.
//
// usage: sweep_scenes COUNT SEED        10,000 scenes take a minute
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "scene/episode.h"
#include "scene/scene_schema.h"
#include "scene/tissue.h"
#include "scene/worlds.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

/// Anything in the range of a key, at any order of magnitude.
double number_for(const SceneKey& key, Random& random) {
  const double most = key.kind == ValueKind::Integer ? std::min(key.most, 30.0) : key.most;
  switch (random.below(6)) {
    case 0:
      return key.least;
    case 1:
      return most;
    case 2:
      return key.zero_too || key.least <= 0.0 ? 0.0 : key.least;
    default:
      break;
  }
  const double size = std::pow(10.0, -12.0 * random.uniform()) * most;
  const double spread =
      key.least > 0.0 ? key.least * std::pow(most / key.least, random.uniform()) : size;
  const double number =
      key.least < 0.0 && random.below(2) == 0 ? std::max(key.least, -spread) : spread;
  return key.kind == ValueKind::Integer ? std::floor(number) : number;
}

json value_for(const SceneKey& key, Random& random) {
  switch (key.kind) {
    case ValueKind::Number:
    case ValueKind::Integer:
      return number_for(key, random);
    case ValueKind::Truth:
      return random.below(2) == 0;
    case ValueKind::Word:
      return key.words[static_cast<std::size_t>(random.below(static_cast<int>(key.words.size())))];
    case ValueKind::NumberOrWord:
      return random.below(3) == 0 ? json("learn") : json(number_for(key, random));
    default:
      return nullptr;
  }
}

/// What is swept: keys that do not decide how large the problem is.
bool is_swept(const SceneKey& key) {
  if (key.path.starts_with("surface.") || key.path == "plan.readings_along_path" ||
      key.path == "plan.row_spacing_mm")
    return false;
  return key.kind != ValueKind::Text && key.kind != ValueKind::Tumours &&
         key.kind != ValueKind::Numbers && key.kind != ValueKind::Points &&
         key.kind != ValueKind::Balls;
}

json random_scene(Random& random) {
  // Outlines take longer to draw than all the rest: one scene in four has them.
  const char* certainty = random.below(4) == 0 ? "sampled" : "laplace";
  json scene = {
      {"certainty", certainty},
      {"surface", {{"plane", {{"size_mm", {20, 20}}, {"vertices", {7, 7}}}}}},
      {"plan", {{"initial", {{"count", 6}}}, {"batch", 4}, {"batches", 2}}},
      {"probe",
       {{"noise", 0.05},
        {"tumours", {{{"shape", "disk"}, {"centre_mm", {10, 10, 0}}, {"radius_mm", 5}}}}}}};
  for (int change = random.below(6); change >= 0; --change) {
    const SceneKey& key =
        scene_keys()[static_cast<std::size_t>(random.below(static_cast<int>(scene_keys().size())))];
    if (!is_swept(key)) continue;
    json* place = &scene;
    std::size_t start = 0;
    for (std::size_t dot = key.path.find('.'); dot != std::string::npos;
         start = dot + 1, dot = key.path.find('.', start))
      place = &(*place)[key.path.substr(start, dot - start)];
    (*place)[key.path.substr(start)] = value_for(key, random);
  }
  return scene;
}

/// Readings anywhere, repeated here and there, of any size, with and without noise of their own.
std::vector<Palpation> random_measurements(const Surface& surface, Random& random) {
  const double origin = random.below(2) == 0 ? 0.0 : std::pow(10.0, 20.0 * random.uniform() - 10.0);
  const double unit = std::pow(10.0, 40.0 * random.uniform() - 20.0);
  std::vector<Palpation> palpations(static_cast<std::size_t>(random.below(30)));
  for (Palpation& palpation : palpations) {
    palpation.where = surface.at_vertex(random.below(surface.vertex_count()));
    palpation.reading = origin + unit * random.normal();
    if (random.below(4) == 0)
      palpation.noise_variance = unit * unit * std::pow(10.0, 20.0 * random.uniform() - 15.0);
    if (random.below(20) == 0) palpation.set_aside = "slipped";
  }
  return palpations;
}

/// The first law that the outcome breaks, or nothing.
std::string broken_law(const Episode& episode) {
  const Exploration& exploration = episode.exploration;
  const Marginals& marginals = exploration.conclusion().marginals;
  if (!marginals.mean.allFinite() || !marginals.variance.allFinite()) return "the field is finite";
  if (marginals.variance.minCoeff() < 0.0) return "variances are not negative";
  if (exploration.conclusion().level && !std::isfinite(exploration.conclusion().level->value))
    return "the level is finite";
  if (episode.estimate.area() > exploration.surface().area() * (1.0 + 1e-12))
    return "a tumour is no larger than the tissue";
  if (episode.error && !std::isfinite(episode.error->symmetric_difference_m2))
    return "the error is finite";
  for (const int stop : exploration.next()) {
    if (stop < 0 || stop >= exploration.surface().vertex_count()) return "stops are vertices";
  }
  return "";
}

struct Tally {
  int done = 0, refused = 0, failed = 0;
};

/// What is wrong, or nothing.
std::string run_one(const json& given, bool measured, Random& random, Tally& tally) {
  try {
    const Scene scene(given, "scene", ".");
    const Tissue tissue = tissue_of(scene);
    const Episode episode =
        measured ? episode_from(scene, tissue.surface, random_measurements(tissue.surface, random))
                 : run_episode(scene, tissue.surface, simulated_world(scene, tissue.surface));
    ++tally.done;
    return broken_law(episode);
  } catch (const NumericalError&) {
    ++tally.failed;
  } catch (const InvalidInput& error) {
    // Readings without noise contradict each other where a file is read; here they come by another
    // way.
    if (std::string(error.what()).find("contradict") == std::string::npos)
      return std::string("an error of the library reached the user: ") + error.what();
    ++tally.refused;
  } catch (const IoError&) {
    ++tally.refused;
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace
}  // namespace palpation::tool

int main(int count, char** words) {
  using namespace palpation;
  if (count != 3) {
    std::fputs("usage: sweep_scenes COUNT SEED\n", stderr);
    return 2;
  }
  Random random(std::strtoull(words[2], nullptr, 10));
  tool::Tally tally;
  for (long number = std::strtol(words[1], nullptr, 10); number > 0; --number) {
    const nlohmann::json scene = tool::random_scene(random);
    const std::string wrong = tool::run_one(scene, number % 2 == 0, random, tally);
    if (wrong.empty()) continue;
    std::printf("%s\n%s\n", wrong.c_str(), scene.dump().c_str());
    return 1;
  }
  std::printf("%d done, %d refused, %d failed in the arithmetic\n", tally.done, tally.refused,
              tally.failed);
  return 0;
}
