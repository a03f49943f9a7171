/// What rows of measurements say together: repeats, contradictions, copies, readings far out.
/// Private to this folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/places.h"
#include "palpation/geometry/surface.h"
#include "palpation/io/csv.h"
#include "palpation/readings/palpation.h"

namespace palpation {

/// Readings by place: repeats are at one place exactly, and without noise they agree.
class Repeats {
 public:
  /// The place that a reading counts for: its own, or an earlier one within reach. Throws IoError
  /// where it contradicts an earlier one.
  SurfacePoint settle(const SurfacePoint& where, const Vec3& position, const CsvTable& table,
                      std::size_t row, double reading, bool exact);

  std::size_t places() const { return places_.size(); }

  void tell(const std::string& name, std::vector<std::string>& warnings) const;

 private:
  struct Exact {
    std::size_t row;
    double reading;
  };
  Places places_;
  std::vector<std::optional<Exact>> exact_rows_;  // by place
  int joined_ = 0;
};

/// Readings that stand out by more than any tissue does are kept, and told: a probe that slipped
/// decides where the level lies.
/// `rows`: of the table, of each.
void tell_outliers(const CsvTable& table, const std::vector<std::size_t>& rows,
                   const std::vector<Palpation>& palpations, std::vector<std::string>& warnings);

/// Throws IoError where readings differ by next to nothing.
void check_range(const CsvTable& table, const std::vector<Palpation>& palpations);

/// Rows that were given twice, alike in all that a reading is, tell nothing new, and readings that
/// never scatter would pass for ones without noise. A sensor that counts may repeat itself to the
/// last digit at a place touched again, but not more often than not. `rows`: of the table, of each.
void set_aside_copies(const CsvTable& table, const std::vector<std::size_t>& rows,
                      const Surface& surface, std::vector<Palpation>& palpations,
                      std::vector<std::string>& warnings);

}  // namespace palpation
