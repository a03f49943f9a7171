#include "scene/worlds.h"

#include <cmath>
#include <limits>
#include <memory>

#include "palpation/base/error.h"
#include "palpation/io/recording.h"
#include "palpation/world/recording.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

constexpr std::uint64_t kProbeStream = 0x70726f6265u;
constexpr std::uint64_t kFaultStream = 0x6661756c74u;

/// Tumours that nobody can find, or nobody can miss, are allowed and told.
std::vector<std::string> warnings_about(const Scene& scene, const Phantom& phantom) {
  std::vector<std::string> warnings;
  if (scene.metres("field.indenter_radius_mm") > 0.0)
    warnings.push_back(scene.name() +
                       ": field.indenter_radius_mm takes back a round tip, but the simulated probe "
                       "is a point: what is found will be too "
                       "small.");
  if (scene.tumours().empty()) return warnings;
  const std::string start = scene.name() + ": probe.tumours: ";
  const Field& truth = phantom.truth();
  if (truth.maxCoeff() < phantom.true_level())
    warnings.push_back(start + "no vertex of the tissue lies in one, so there is nothing to find.");
  if (truth.minCoeff() >= phantom.true_level())
    warnings.push_back(start + "all of the tissue lies in one, so there is no boundary to find.");
  return warnings;
}

bool is_refused(const Surface& surface, const RecordedReadings& recording) {
  try {
    RecordedWorld(surface, {recording});
    return false;
  } catch (const InvalidInput&) {
    return true;
  }
}

std::shared_ptr<const RecordedWorld> world_of(const Surface& surface,
                                              const std::vector<std::filesystem::path>& paths) {
  std::vector<RecordedReadings> recordings;
  for (const auto& path : paths) recordings.push_back(read_recording(path));
  try {
    return std::make_shared<const RecordedWorld>(surface, recordings);
  } catch (const InvalidInput&) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (is_refused(surface, recordings[i]))
        throw IoError(
            paths[i].string() +
            ": its readings on the tissue must be three at least, and not all on one line");
    }
    throw;
  }
}

}  // namespace

namespace {

/// What the phantom gives, as a sensor with the world's faults reports it.
Probe faulty_probe(const Scene& scene, const Surface& surface, const DrawnWorld& drawn,
                   const std::shared_ptr<const Phantom>& phantom,
                   const std::shared_ptr<Random>& random) {
  const auto sensor = std::make_shared<FaultySensor>(
      drawn.faults, drawn.change, scene.number("probe.low"), scene.number("probe.high"));
  const auto faults = std::make_shared<Random>(scene.seed() ^ kFaultStream);
  return [=](const SurfacePoint& where, const Vec3& travel) {
    Palpation palpation = phantom->touch(sensor->feels_at(surface, where), travel, *random);
    palpation.where = where;
    // Stops are at vertices, readings on the way between them.
    const TouchKind kind = surface.vertex_at(where) >= 0 ? TouchKind::Stop : TouchKind::Way;
    palpation.reading = sensor->reported(palpation.reading, *faults, kind);
    return std::optional(palpation);
  };
}

}  // namespace

World simulated_world(const Scene& scene, const Surface& surface) {
  const DrawnWorld drawn = world_of(scene, surface);
  const auto phantom = std::make_shared<Phantom>(phantom_of(scene, surface, drawn.design));
  const auto random = std::make_shared<Random>(scene.seed() ^ kProbeStream);
  World world;
  world.probe = [phantom, random](const SurfacePoint& where, const Vec3& travel) {
    return std::optional(phantom->touch(where, travel, *random));
  };
  if (scene.has("probe.world")) world.probe = faulty_probe(scene, surface, drawn, phantom, random);
  world.truth = phantom->truth();
  world.true_level = phantom->true_level();
  world.warnings = warnings_about(scene, *phantom);
  return world;
}

World recorded_world(const Scene& scene, const Surface& surface,
                     const std::vector<std::filesystem::path>& paths) {
  const std::shared_ptr<const RecordedWorld> recorded = world_of(surface, paths);
  World world;
  world.probe = [recorded](const SurfacePoint& where, const Vec3& travel) {
    return recorded->touch(where, travel);
  };
  const double low = recorded->quantile(0.02);
  const double high = recorded->quantile(0.98);
  world.truth = recorded->map(low);
  world.truth_is = "the recording's own map";
  world.true_level = low + scene.number("level.fraction") * (high - low);
  if (!(high > low)) {
    world.true_level =
        std::nextafter(world.truth.maxCoeff(), std::numeric_limits<double>::infinity());
    world.warnings.push_back(paths.front().string() +
                             ": all its readings are equal, so it shows no tumour.");
  }
  const std::vector<bool> in_contact = recorded->in_contact();
  std::vector<int> felt;
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (in_contact[vertex]) felt.push_back(vertex);
  }
  if (felt.empty())
    throw IoError(paths.front().string() +
                  ": no vertex of the tissue lies within 2 mm of its readings: do mesh and "
                  "recording share a frame, and is it in metres?");
  world.reach = {.vertices = std::move(felt), .touch_once = true};
  return world;
}

}  // namespace palpation::tool
