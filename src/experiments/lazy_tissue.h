/// The tissue of a scene, read when it is first asked for: to print scenes no mesh is needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "scene/digest.h"
#include "scene/tissue.h"

namespace palpation::tool {

class LazyTissue {
 public:
  explicit LazyTissue(Scene scene) : state_(std::make_shared<State>(std::move(scene))) {}

  const Surface& surface() const {
    std::call_once(state_->once, [&] { state_->tissue = tissue_of(state_->scene); });
    return state_->tissue->surface;
  }
  std::string mesh_digest() const { return digest(surface().mesh()); }

 private:
  struct State {
    explicit State(Scene of) : scene(std::move(of)) {}
    Scene scene;
    std::once_flag once;
    std::optional<Tissue> tissue;
  };
  std::shared_ptr<State> state_;
};

}  // namespace palpation::tool
