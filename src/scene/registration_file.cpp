#include "scene/registration_file.h"

#include <cmath>
#include <ctime>

#include "palpation/base/error.h"
#include "scene/scene_json.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

using nlohmann::json;

constexpr double kMm = 1e3;  // in a metre
constexpr double kOld_h = 12.0;

/// Of "2026-11-23T08:00:00Z", since 1970; nothing where it is not written so.
std::optional<std::time_t> seconds_of(const std::string& words) {
  std::tm parts{};
  const char* end = ::strptime(words.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return ::timegm(&parts);
}

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

std::string registration_document(const Registration& registration, const Surface& surface,
                                  const std::string& touched) {
  json residuals_mm = json::array();
  for (const double one : registration.residuals_m) residuals_mm.push_back(one * kMm);
  const json document{
      {"from_tissue", rows_of(registration.from_tissue)},
      {"uncertainty_mm", uncertainty_along_normal_m(surface, registration) * kMm},
      {"place_uncertainty_mm", uncertainty_along_surface_m(surface, registration) * kMm},
      {"touched", touched},
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
  // Files of the first version do not have these.
  const json place = document.value("place_uncertainty_mm", json(0.0)),
             touched = document.value("touched", json(""));
  if (!place.is_number() || !(place >= 0.0 && place < 1000.0))
    refuse("place_uncertainty_mm: must be a number from 0 to 1000");
  file.place_uncertainty_m = place.get<double>() / kMm;
  if (!touched.is_string() || (touched != "" && !seconds_of(touched.get<std::string>())))
    refuse("touched: must be a time such as 2026-11-23T08:00:00Z");
  file.touched = touched.get<std::string>();
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

double place_uncertainty_m(const Scene& scene) {
  const auto registration = registration_of(scene);
  if (!registration || scene.gives("robot.place_uncertainty_mm"))
    return scene.metres("robot.place_uncertainty_mm");
  return registration->place_uncertainty_m;
}

RegistrationAge registration_age(const Scene& scene) {
  const auto registration = registration_of(scene);
  const auto then_s = registration ? seconds_of(registration->touched) : std::nullopt;
  if (!then_s)
    return {registration ? "registered, and the file does not say when"
                         : "given by the scene, without saying when it was registered"};
  const double hours = std::difftime(std::time(nullptr), *then_s) / 3600.0;
  const std::string at = " (" + registration->touched + ")";
  if (hours < 0.0) return {"registered in the future" + at + ": a clock is wrong", true};
  const std::string ago = hours < 1.0    ? counted(static_cast<std::size_t>(60.0 * hours), "minute")
                          : hours < 48.0 ? counted(static_cast<std::size_t>(hours), "hour")
                                         : counted(static_cast<std::size_t>(hours / 24.0), "day");
  return {"registered " + ago + " ago" + at, hours >= kOld_h};
}

std::string registration_remark(const Scene& scene) {
  const RegistrationAge age = registration_age(scene);
  return age.is_old ? "Where the tissue is was " + age.words + ": was anything moved since?" : "";
}

}  // namespace palpation::tool
