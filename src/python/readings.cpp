#include "python/readings.h"

#include <cmath>

#include "palpation/base/error.h"
#include "python/arrays.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

// As a measurements file has it: what is computed from these stays within the range of doubles.
constexpr double kGreatestReading = 1e30;
constexpr double kGreatestVariance = 1e60;
constexpr double kLeastVariance = 1e-60;

[[noreturn]] void refuse(const char* function, const char* name, Eigen::Index row,
                         const std::string& value, const std::string& rule) {
  throw InvalidInput(std::string(function) + ": " + name + ": row " + std::to_string(row) + " is " +
                     value + ", must be " + rule);
}

void check_readings(const Eigen::VectorXd& values, const char* function) {
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    if (std::abs(values[row]) > kGreatestReading)
      refuse(function, "readings", row, text_of(values[row]),
             "at most 1e30 in size: give them in another unit");
  }
}

void check_variances(const Eigen::VectorXd& variances, const char* function) {
  for (Eigen::Index row = 0; row < variances.size(); ++row) {
    const double variance = variances[row];
    if (std::isnan(variance) || variance == 0.0 ||
        (variance >= kLeastVariance && variance <= kGreatestVariance))
      continue;
    refuse(function, "noise_variance", row, text_of(variance), "NaN, 0, or 1e-60 to 1e60");
  }
}

/// What is a unit vector but for rounding keeps its digits.
Vec3 direction_of(const Vec3& travel) {
  if (travel.isZero(0.0) || std::abs(travel.norm() - 1.0) <= 1e-12) return travel;
  return travel.stableNormalized();
}

}  // namespace

std::vector<Palpation> palpations_of(const std::vector<SurfacePoint>& places, const Felt& felt,
                                     const char* function) {
  const auto count = static_cast<Eigen::Index>(places.size());
  const Eigen::VectorXd values =
      numbers_of(felt.values, {function, "readings"}, count, Missing::Welcome);
  check_readings(values, function);
  Eigen::VectorXd variances =
      Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  if (!felt.noise_variance.is_none())
    variances =
        spread_of(felt.noise_variance, {function, "noise_variance"}, count, Missing::Welcome);
  check_variances(variances, function);
  Points travel = Points::Zero(count, 3);
  if (!felt.travel.is_none()) travel = points_of(felt.travel, {function, "travel"});
  if (travel.rows() != count)
    throw InvalidInput(std::string(function) + ": travel: has " + std::to_string(travel.rows()) +
                       " rows, must have " + std::to_string(count));

  std::vector<Palpation> palpations;
  for (Eigen::Index row = 0; row < count; ++row) {
    const SurfacePoint& where = places[static_cast<std::size_t>(row)];
    if (std::isnan(values[row])) {
      palpations.push_back(missed_at(where));
      continue;
    }
    palpations.push_back({.where = where,
                          .reading = values[row],
                          .noise_variance = variances[row],
                          .travel = direction_of(travel.row(row).transpose())});
  }
  return palpations;
}

void require_same_surface(const Surface& surface, const Surface& other, const char* function) {
  const bool same =
      &surface.mesh() == &other.mesh() || (surface.mesh().triangles == other.mesh().triangles &&
                                           surface.mesh().vertices == other.mesh().vertices);
  require(same, function, "readings", "must be of the same surface");
}

}  // namespace palpation::python
