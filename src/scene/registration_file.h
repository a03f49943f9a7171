/// T.json: where the tissue is in the robot's frame, as `palpate register` found it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpation/robot/registration.h"
#include "scene/scene.h"

namespace palpation::tool {

struct RegistrationFile {
  Eigen::Matrix4d from_tissue = Eigen::Matrix4d::Identity();
  double uncertainty_m = 0.0;        ///< along the tissue's normal, 95 %
  double place_uncertainty_m = 0.0;  ///< along the tissue, 95 %
  std::string touched{};             ///< when, UTC, such as 2026-11-23T08:00:00Z; empty: not said
};

std::string registration_document(const Registration& registration, const Surface& surface,
                                  const std::string& touched);
/// Throws IoError where it cannot be read or is none.
RegistrationFile read_registration(const std::filesystem::path& path);
/// Relative to the scene, or where there is none to where the tool runs.
std::filesystem::path registration_path(const Scene& scene);
/// That the scene names by robot.registration; nothing where it names none.
/// Throws IoError where it gives robot.from_tissue, too.
std::optional<RegistrationFile> registration_of(const Scene& scene);

/// How far, with 95 %, all places may lie off along the tissue, the same way: what the scene gives,
/// or else its registration says; 0 where neither does.
double place_uncertainty_m(const Scene& scene);

/// How old what says where the tissue is, in words: "registered 3 h ago", by the machine's clock.
struct RegistrationAge {
  std::string words;
  bool is_old = false;  ///< half a day or more: something may have been moved since
};
RegistrationAge registration_age(const Scene& scene);
/// A remark where it is old; else empty.
std::string registration_remark(const Scene& scene);

}  // namespace palpation::tool
