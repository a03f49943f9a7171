#include "scene/scale_remarks.h"

#include "scene/surface_remarks.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

std::string mm(double length_m) { return fixed(length_m * 1000.0, 1) + " mm"; }

/// Waves longer than the tissue are all alike: the field would be one value and whatever the trend
/// leaves. An intrinsic one meets itself from half of it on.
std::string long_words(const Scene& scene, const Surface& surface, double length_m) {
  const bool is_intrinsic = scene.word("field.metric") == "intrinsic";
  if (length_m <= (is_intrinsic ? 0.5 : 1.0) * surface.diameter()) return "";
  return scene.name() + ": field.length_mm " + fixed(length_m * 1000.0, 1) +
         " is long for tissue that is " + mm(surface.diameter()) +
         " across: " + (is_intrinsic ? "with field.metric intrinsic the" : "the") +
         " field can hardly vary over it.";
}

std::string short_words(const Scene& scene, const Surface& surface, double length_m) {
  const double edge_m = edge_lengths(surface.mesh()).mean_m;
  if (length_m >= edge_m) return "";
  return scene.name() + ": field.length_mm " + text_of(length_m * 1000.0) +
         " is shorter than the edges of the tissue, " + fixed(edge_m * 1000.0, 2) +
         " mm on average: a reading tells nothing of the next vertex. Set surface.refine_mm, or a "
         "longer length.";
}

std::string spacing_words(const Scene& scene, const Surface& surface) {
  if (!scene.gives("plan.least_spacing_mm") || scene.integer("plan.batch") < 2) return "";
  const double spacing_m = scene.metres("plan.least_spacing_mm");
  if (spacing_m < surface.diameter()) return "";
  return scene.name() + ": plan.least_spacing_mm " + fixed(spacing_m * 1000.0, 1) +
         " is wider than the tissue, " + mm(surface.diameter()) +
         " across: a batch has one stop only.";
}

}  // namespace

std::vector<std::string> scale_remarks(const Scene& scene, const Surface& surface) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) remarks.push_back(words);
  };
  if (scene.gives("field.length_mm") && scene.word("field.length_mm") != "learn") {
    const double length_m = scene.metres("field.length_mm");
    add(long_words(scene, surface, length_m));
    add(short_words(scene, surface, length_m));
  }
  add(spacing_words(scene, surface));
  return remarks;
}

}  // namespace palpation::tool
