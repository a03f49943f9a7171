#include "tool/worlds.h"

#include <memory>

#include "palpation/base/error.h"
#include "palpation/io/recording.h"
#include "palpation/world/recording.h"
#include "tool/setup.h"

namespace palpation::tool {
namespace {

constexpr std::uint64_t kProbeStream = 0x70726f6265u;

}  // namespace

World simulated_world(const Scene& scene, const Surface& surface) {
  const auto phantom = std::make_shared<Phantom>(phantom_of(scene, surface));
  const auto random = std::make_shared<Random>(scene.seed() ^ kProbeStream);
  World world;
  world.probe = [phantom, random](const SurfacePoint& where, const Vec3&) { return std::optional(phantom->touch(where, *random)); };
  world.truth = phantom->truth();
  world.true_level = phantom->true_level();
  return world;
}

World recorded_world(const Scene& scene, const Surface& surface, const std::vector<std::filesystem::path>& paths) {
  std::vector<RecordedReadings> recordings;
  for (const auto& path : paths) recordings.push_back(read_recording(path));
  const auto recorded = std::make_shared<RecordedWorld>(surface, std::move(recordings));
  World world;
  world.probe = [recorded](const SurfacePoint& where, const Vec3& travel) { return recorded->touch(where, travel); };
  const double low = recorded->quantile(0.02);
  const double high = recorded->quantile(0.98);
  world.truth = recorded->map(low);
  world.true_level = low + scene.number("level.fraction") * (high - low);
  const std::vector<bool> in_contact = recorded->in_contact();
  for (int vertex = 0; vertex < surface.vertex_count(); ++vertex) {
    if (in_contact[vertex]) world.reach.vertices.push_back(vertex);
  }
  if (world.reach.vertices.empty())
    throw InvalidInput("replay: no vertex of the tissue lies within 2 mm of the recording: do mesh and recording share a frame?");
  world.reach.touch_once = true;
  return world;
}

}  // namespace palpation::tool
