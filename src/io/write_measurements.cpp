#include <cmath>
#include <string>
#include <vector>

#include "io/measurement_columns.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "palpation/io/measurements.h"

namespace palpation {
namespace {

std::string kind_text(TouchKind kind) {
  if (kind == TouchKind::Missed) return "missed";
  return kind == TouchKind::Way ? "way" : "stop";
}

std::string reading_text(const Palpation& palpation) {
  return palpation.kind == TouchKind::Missed ? std::string() : text_of(palpation.reading);
}

std::string noise_text(double variance) {
  return std::isnan(variance) ? std::string() : text_of(variance);
}

}  // namespace

std::string measurements_csv(const Surface& surface, std::span<const Palpation> palpations,
                             const ForeignColumns& foreign) {
  require(foreign.names.empty() || foreign.rows.size() == palpations.size(), "measurements_csv",
          std::to_string(foreign.rows.size()) + " rows of foreign columns",
          "must be as many as palpations, " + std::to_string(palpations.size()));
  std::vector<std::string> header(kMeasurementColumns.begin(), kMeasurementColumns.end());
  header.insert(header.end(), foreign.names.begin(), foreign.names.end());
  std::string text = csv_line(header);
  for (std::size_t row = 0; row < palpations.size(); ++row) {
    const Palpation& palpation = palpations[row];
    const Vec3 position = surface.position(palpation.where);
    const auto travel = [&](int i) {
      return palpation.travel.isZero(0.0) ? std::string() : text_of(palpation.travel[i]);
    };
    std::vector<std::string> cells = {text_of(position.x()),
                                      text_of(position.y()),
                                      text_of(position.z()),
                                      reading_text(palpation),
                                      noise_text(palpation.noise_variance),
                                      std::to_string(palpation.batch),
                                      kind_text(palpation.kind),
                                      travel(0),
                                      travel(1),
                                      travel(2),
                                      palpation.set_aside};
    if (!foreign.names.empty())
      cells.insert(cells.end(), foreign.rows[row].begin(), foreign.rows[row].end());
    text += csv_line(cells);
  }
  return text;
}

}  // namespace palpation
