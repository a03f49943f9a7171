// Scenes, up to all that is made of them before a mesh is read.
#include "scene/scene.h"

#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "scene/setup.h"

namespace palpation::fuzz {
namespace {

template <typename Make>
void try_to(Make make) {
  try {
    make();
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  using fuzz::try_to;
  const fuzz::MemoryFile file(bytes, size);
  try_to([&] {
    const tool::Scene scene = tool::Scene::read(file.path(), {});
    fuzz::expect(scene.complete().is_object(), "a scene is an object");
    try_to([&] { tool::model_of(scene); });
    try_to([&] { tool::plan_of(scene); });
    try_to([&] { tool::robot_of(scene); });
    try_to([&] {
      tool::phantom_of(scene, fuzz::sheet(), tool::world_of(scene, fuzz::sheet()).design);
    });
  });
  return 0;
}
