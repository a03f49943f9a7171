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
  double uncertainty_m = 0.0;  ///< along the tissue's normal, 95 %
};

std::string registration_document(const Registration& registration, double uncertainty_m);
/// Throws IoError where it cannot be read or is none.
RegistrationFile read_registration(const std::filesystem::path& path);
/// Relative to the scene, or where there is none to where the tool runs.
std::filesystem::path registration_path(const Scene& scene);
/// That the scene names by robot.registration; nothing where it names none.
/// Throws IoError where it gives robot.from_tissue, too.
std::optional<RegistrationFile> registration_of(const Scene& scene);

}  // namespace palpation::tool
