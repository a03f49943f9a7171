#include "exploration/screened_readings.h"

#include "palpation/belief/lag.h"
#include "palpation/readings/screening.h"

namespace palpation {

std::vector<Palpation> screened_readings(const Surface& surface, const FieldModel& field,
                                         std::span<const Palpation> recorded, double lag_m) {
  std::vector<Palpation> result(recorded.begin(), recorded.end());
  if (!field.probe.screening || recorded.empty()) return result;
  if (!field.probe.has_lag()) return screened(surface, recorded);
  std::vector<Palpation> moved = displaced(surface, recorded, lag_m);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i].travel.setZero();
    moved[i].set_aside = recorded[i].set_aside;
  }
  moved = screened(surface, moved);
  for (std::size_t i = 0; i < moved.size(); ++i) result[i].set_aside = moved[i].set_aside;
  return result;
}

}  // namespace palpation
