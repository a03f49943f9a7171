#include "exploration/screened_readings.h"

#include <algorithm>

#include "palpation/belief/lag.h"
#include "palpation/readings/screening.h"

namespace palpation {

std::vector<Palpation> screened_readings(const Surface& surface, const FieldModel& field,
                                         std::span<const Palpation> recorded, double lag_m) {
  std::vector<Palpation> result(recorded.begin(), recorded.end());
  if (recorded.empty()) return result;
  const double length_m = std::min(kernel_of(field.kernel).length_m, field.kernel.length_median_m);
  const auto screen = [&](const Surface& tissue, std::span<const Palpation> felt) {
    return field.probe.screening ? screened(tissue, felt) : plausible(tissue, felt, length_m);
  };
  if (!field.probe.has_lag()) return screen(surface, recorded);
  std::vector<Palpation> moved = displaced(surface, recorded, lag_m);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i].travel.setZero();
    moved[i].set_aside = recorded[i].set_aside;
  }
  moved = screen(surface, moved);
  for (std::size_t i = 0; i < moved.size(); ++i) result[i].set_aside = moved[i].set_aside;
  return result;
}

}  // namespace palpation
