/// What a run shows of itself: surfaces, lines and lists of places, by the names that they have in
/// every other program.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/vtp_shape.h"
#include "results/markups.h"
#include "results/run.h"

namespace palpation::results {

/// A surface or lines; without points where there is no such thing.
struct NamedModel {
  std::string name;
  VtpShape shape;
};

/// "tissue", "tumour", "band", "not_searched", "outline", "band_lines", "cut_line" and
/// "true_outline": all of them, in that order.
std::vector<NamedModel> models_of(const Run& run);

/// Places in one colour, each with a label.
struct NamedMarks {
  std::string name;
  std::array<double, 3> colour{};  ///< red, green, blue, each from 0 to 1
  std::vector<Mark> marks;
};

/// "touches", "set_aside", "missed" and "next_stops": all of them, in that order. Readings on the
/// way, which come by the thousand, are in none but where they were set aside. A touch is labelled
/// by its number; a next stop by its place in the tour, the first of which is `first_stop`.
std::vector<NamedMarks> marks_of(const Run& run, int first_stop = 1);

}  // namespace palpation::results
