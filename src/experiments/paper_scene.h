/// The simulations of Garg et al. 2016, with the constants of the authors' public code.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace palpation::tool {

/// The phantom and the model: GPy's squared exponential of variance 25 (z-scored readings),
/// likelihood variance 1, a constant of variance 52; the level known. Without tumours.
nlohmann::json paper_scene();

/// The same phantom and number of touches; model, level and choice of touches are the tool's own
/// defaults, and know nothing of it.
nlohmann::json default_scene();

/// The length of the outline, metres.
double paper_perimeter_m(const std::string& shape);

/// One disk, or one horseshoe open to -x with a solid half, in millimetres, as probe.tumours.
nlohmann::json disk_mm(double x, double y, double radius);
nlohmann::json horseshoe_mm(double x, double y, double arc_radius, double half_width);

/// "disk" or "horseshoe", as probe.tumours.
nlohmann::json paper_tumour(const std::string& shape);

inline const std::vector<std::string> kPaperShapes = {"disk", "horseshoe"};
inline const std::vector<std::string> kPaperAlgorithms = {"evr", "ucb", "ils-ucb"};

}  // namespace palpation::tool
