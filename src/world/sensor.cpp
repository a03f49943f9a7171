#include "palpation/world/sensor.h"

#include <cmath>
#include <numbers>

#include "palpation/base/error.h"

namespace palpation {
namespace {

void need(bool condition, const std::string& what, double value, const std::string& rule) {
  require(condition, "FaultySensor", what + " " + text_of(value), rule);
}

void need_part(double value, const std::string& what) {
  need(value >= 0.0 && value <= 1.0, what, value, "must lie in [0, 1]");
}

}  // namespace

FaultySensor::FaultySensor(const SensorFaults& faults, const SensorChange& change, double low,
                           double high)
    : faults_(faults), change_(change), low_(low), range_(high - low), last_(low) {
  need(std::isfinite(range_) && range_ > 0.0, "high", high, "must be finite and above low");
  need_part(faults.lost, "lost");
  need_part(faults.wild, "wild");
  need_part(faults.jammed, "jammed");
  need(std::isfinite(faults.wild_ranges) && faults.wild_ranges >= 0.0, "wild ranges",
       faults.wild_ranges, "must be finite and not negative");
  need(std::isfinite(faults.drift), "drift", faults.drift, "must be finite");
  need(std::isfinite(faults.breath.phase), "breath's phase", faults.breath.phase, "must be finite");
  require(faults.breath.by_m.allFinite(), "FaultySensor", "breath", "must be finite");
  need(faults.breath.readings > 0.0, "breath", faults.breath.readings,
       "must last for more than no reading");
  need(std::isfinite(change.zero), "zero", change.zero, "must be finite");
  need(std::isfinite(change.gain), "gain", change.gain, "must be finite");
  require(change.moved_m.allFinite(), "FaultySensor", "moved", "must be finite");
}

SurfacePoint FaultySensor::feels_at(const Surface& surface, const SurfacePoint& where) const {
  const Breath& breath = faults_.breath;
  Vec3 off_m =
      std::sin(2.0 * std::numbers::pi * readings_ / breath.readings + breath.phase) * breath.by_m;
  if (has_changed()) off_m += change_.moved_m;
  if (off_m.isZero(0.0)) return where;
  return surface.project(surface.position(where) + off_m);
}

double FaultySensor::reported(double reading, Random& random, TouchKind kind) {
  const double lost = random.uniform(), wild = random.uniform(), jammed = random.uniform();
  const double anything = 2.0 * random.uniform() - 1.0;
  double told = reading + faults_.drift * range_ * readings_ / 100.0;
  if (has_changed()) told = low_ + change_.gain * (told - low_) + change_.zero * range_;
  if (jammed < faults_.jammed) told = last_;
  if (wild < faults_.wild) told = low_ + range_ * (0.5 + faults_.wild_ranges * anything);
  if (lost < faults_.lost) told = 0.0;
  last_ = told;
  ++readings_;
  if (kind == TouchKind::Stop) ++stops_;
  return told;
}

}  // namespace palpation
