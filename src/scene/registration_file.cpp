#include "scene/registration_file.h"

#include <cmath>

#include "palpation/base/error.h"
#include "scene/scene_json.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm = 1e3;  // in a metre

template <typename Matrix>
json rows_of(const Matrix& matrix) {
  json numbers = json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      numbers.push_back(matrix(row, column));
  return numbers;
}

bool are_numbers(const json& list, std::size_t count) {
  if (!list.is_array() || list.size() != count) return false;
  for (const json& one : list)
    if (!one.is_number()) return false;
  return true;
}

}  // namespace

std::string registration_document(const Registration& registration, double uncertainty_m) {
  json residuals_mm = json::array();
  for (const double one : registration.residuals_m) residuals_mm.push_back(one * kMm);
  const json document{{"from_tissue", rows_of(registration.from_tissue)},
                      {"uncertainty_mm", uncertainty_m * kMm},
                      {"rms_mm", registration.rms_m * kMm},
                      {"residuals_mm", residuals_mm},
                      {"covariance", rows_of(registration.covariance)},
                      {"centre_m", rows_of(registration.centre)}};
  return document.dump(2) + "\n";
}

RegistrationFile read_registration(const std::filesystem::path& path) {
  const json document = read_json(path);
  const auto refuse = [&](const std::string& words) {
    throw IoError(path.string() + ": " + words);
  };
  if (!document.is_object() || !document.contains("from_tissue") ||
      !are_numbers(document.at("from_tissue"), 16))
    refuse("from_tissue: must be a list of 16 numbers, as palpate register writes it");
  RegistrationFile file;
  for (int i = 0; i < 16; ++i)
    file.from_tissue(i / 4, i % 4) = document.at("from_tissue").at(i).get<double>();
  if (!document.contains("uncertainty_mm") || !document.at("uncertainty_mm").is_number())
    refuse("uncertainty_mm: must be a number, as palpate register writes it");
  file.uncertainty_m = document.at("uncertainty_mm").get<double>() / kMm;
  if (!(file.uncertainty_m >= 0.0 && file.uncertainty_m < 1.0))
    refuse("uncertainty_mm: must be from 0 to 1000");
  return file;
}

std::filesystem::path registration_path(const Scene& scene) {
  const std::filesystem::path given = scene.word("robot.registration"),
                              beside_scene = scene.folder() / given;
  std::error_code none;
  const bool is_beside = std::filesystem::exists(beside_scene, none);
  return is_beside || !std::filesystem::exists(given, none) ? beside_scene : given;
}

std::optional<RegistrationFile> registration_of(const Scene& scene) {
  if (!scene.gives("robot.registration")) return std::nullopt;
  if (scene.gives("robot.from_tissue"))
    scene.refuse("robot.registration", "stands in place of robot.from_tissue: give one of them");
  return read_registration(registration_path(scene));
}

}  // namespace palpation::tool
