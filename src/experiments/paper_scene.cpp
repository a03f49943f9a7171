#include "experiments/paper_scene.h"

#include <numbers>

namespace palpation::tool {

using nlohmann::json;

json paper_scene() {
  return {{"version", 1},
          {"surface", {{"plane", {{"size_mm", {25, 50}}, {"vertices", {200, 200}}}}}},
          {"field",
           {{"metric", "chart"},
            {"kernel", "squared-exponential"},
            {"length_mm", 3.3},
            {"signal_sd", 5},
            {"noise_to_signal", 0.2},
            {"trend", "constant"},
            {"constant_sd", 7.211102550927978},
            {"standardize", true}}},
          {"level", {{"estimate", "known"}, {"value", 8}, {"fraction", 0.5}}},
          {"plan",
           {{"acquisition", "ils-ucb"},
            {"gamma", 0.5},
            {"scaling", "max"},
            {"initial", {{"design", "random"}, {"count", 5}}},
            {"batch", 10},
            {"batches", 10},
            {"least_spacing_mm", 0},
            {"safe_start", false}}},
          {"probe",
           {{"kind", "simulated"},
            {"low", 7},
            {"high", 9},
            {"slope_per_m", 1400},
            {"noise", 0.01},
            {"bias", 0},
            {"bias_axis", {0, 1, 0}},
            {"tumours", json::array()}}},
          {"seed", 0}};
}

json default_scene() {
  json scene = paper_scene();
  scene.erase("field");
  scene["level"] = {{"fraction", 0.5}};
  for (const char* key : {"acquisition", "gamma", "scaling", "least_spacing_mm", "safe_start"})
    scene["plan"].erase(key);
  return scene;
}

/// The disk's circle; the horseshoe's two half circles and its two round caps.
double paper_perimeter_m(const std::string& shape) {
  return std::numbers::pi * (shape == "disk" ? 2.0 * 0.00625 : 2.0 * 0.007 + 2.0 * 0.0025);
}

json disk_mm(double x, double y, double radius) {
  return json::array({{{"shape", "disk"}, {"centre_mm", {x, y, 0}}, {"radius_mm", radius}}});
}

json horseshoe_mm(double x, double y, double arc_radius, double half_width) {
  return json::array({{{"shape", "horseshoe"},
                       {"centre_mm", {x, y, 0}},
                       {"arc_radius_mm", arc_radius},
                       {"half_width_mm", half_width},
                       {"arc_deg", 180},
                       {"facing", {1, 0, 0}}}});
}

json paper_tumour(const std::string& shape) {
  return shape == "disk" ? disk_mm(11.492, 30, 6.25) : horseshoe_mm(9.492, 20, 7, 2.5);
}

}  // namespace palpation::tool
