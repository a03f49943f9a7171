/// The readings that a screen looks at, in the order in which they were made, and what its rules
/// find in them. Each rule sets readings aside; none takes one back.
#pragma once

#include <string>
#include <vector>

#include "palpation/readings/screening.h"
#include "readings/passes.h"

namespace palpation {

/// Fewer rows say nothing about what rows have in common.
inline constexpr std::size_t kLeastRows = 3;
/// Of the way between two groups of readings: a gap that no tissue leaves is wider.
inline constexpr double kGapWidth = 0.25;
/// Robust standard deviations.
inline constexpr double kSure = 4.0;
/// Between readings made in motion; farther apart they are pokes, each from rest.
inline constexpr double kSliding_m = 0.0011;

struct Screen {
  std::vector<Palpation>& palpations;
  std::vector<Vec3> places;

  bool uses(std::size_t i) const { return palpations[i].set_aside.empty(); }
  double reading(std::size_t i) const { return palpations[i].reading; }
  void set_aside(std::size_t i, const std::string& reason) {
    if (uses(i)) palpations[i].set_aside = reason;
  }
  std::vector<double> used(const std::vector<std::size_t>& of) const {
    std::vector<double> values;
    for (std::size_t i : of) {
      if (uses(i)) values.push_back(reading(i));
    }
    return values;
  }
};

/// Jams lie above tissue's readings, lost contact below them (levels_apart.cpp). `pokes`: each from
/// rest.
void find_levels_apart(Screen& screen, bool pokes);

/// Of another sign since some moment of a session, or many times as large (another_unit.cpp).
void find_another_unit(Screen& screen);

/// Faults of rows, of which each crosses most of the tissue (row_faults.cpp).
void find_flat_rows(Screen& screen, const std::vector<Pass>& rows);
void find_start_ups(Screen& screen, const std::vector<Pass>& rows);
void find_parts_apart(Screen& screen, const std::vector<Pass>& rows);
void find_transitions(Screen& screen, const std::vector<Pass>& rows);
void find_base_steps(Screen& screen, const std::vector<Pass>& rows);

}  // namespace palpation
