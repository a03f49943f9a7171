#include "scene/background_words.h"

#include <cmath>

#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kTiltOver_m = 0.01;

}  // namespace

std::string tilt_words(ReadingScale scale, const Vec3& slope_per_m) {
  const double rise = slope_per_m.norm() * kTiltOver_m;
  const Vec3 way = slope_per_m.normalized();
  const std::string by = scale == ReadingScale::Log
                             ? "become " + fixed(std::exp(rise), 2) + " times as high"
                             : "rise by " + reading_text(rise);
  return "Readings slope all over the tissue: they " + by + " for each 10 mm towards " + "(" +
         fixed(way.x(), 2) + ", " + fixed(way.y(), 2) + ", " + fixed(way.z(), 2) + ")" +
         ". That is taken from them; where the tissue or the sensor is known to slope, set "
         "field.trend to linear.";
}

std::string waves_words(const Surface& surface, ReadingScale scale, const Field& waves) {
  Eigen::Index lowest = 0, highest = 0;
  const double rise = waves.maxCoeff(&highest) - waves.minCoeff(&lowest);
  const auto at = [&](Eigen::Index vertex) {
    return place_words(surface.vertex(static_cast<int>(vertex)), 1);
  };
  const std::string by = scale == ReadingScale::Log
                             ? "are " + fixed(std::exp(rise), 2) + " times as high at "
                             : "lie " + reading_text(rise) + " higher at ";
  return "Readings rise and fall slowly all over the tissue: without what has an edge they " + by +
         at(highest) + " than at " + at(lowest) + ". That is taken from them.";
}

std::string drift_words(ReadingScale scale, const Unevenness& background) {
  Eigen::Index lowest = 0, highest = 0;
  const double rise = background.drift.maxCoeff(&highest) - background.drift.minCoeff(&lowest);
  const std::string by = scale == ReadingScale::Log
                             ? "are " + fixed(std::exp(rise), 2) + " times as high"
                             : "lie " + reading_text(rise) + " higher";
  return "Readings rise and fall as time goes on, as a sensor that drifts makes them: wherever "
         "they are, they " +
         by + " about reading " + std::to_string(highest + 1) + " than about reading " +
         std::to_string(lowest + 1) +
         ". That is taken from them; where the way leads over the tissue as time goes on, tissue "
         "may do the same: touch again in another order.";
}

std::string errors_words(ReadingScale scale, const LastingErrors& errors) {
  return "Readings that were made one after the other err alike, over some " +
         fixed(errors.readings, 0) + " of them, by " +
         (scale == ReadingScale::Log ? percent(errors.sd) : reading_text(errors.sd)) +
         ", as a sensor that drifts makes them, or something that lies along the way. The band "
         "knows of it: touch again in another order to tell which.";
}

}  // namespace palpation::tool
