/// What a run found, as parts of the tissue and lines on it.
#pragma once

#include <string>
#include <vector>

#include "io/vtp_shape.h"
#include "results/run.h"

namespace palpation::results {

/// The fields that others want to see, as far as there are any.
std::vector<std::string> shown_fields();

/// Inside of the estimated boundary; without triangles where none was found.
VtpShape tumour_of(const Run& run);

/// Between the band's two curves; without triangles where no band is known.
VtpShape band_of(const Run& run);

/// Farther than this from every reading that counts a tumour of 0.5 cm2 may lie unfelt: twice the
/// radius of one. The boundary's own doubt begins at the same distance (certainty.h).
inline constexpr double kSearched_m = 0.008;

/// The tissue that no reading is near, in a straight line; all of it where nothing was felt, and
/// nothing where nobody says what was.
VtpShape not_searched_of(const Run& run);
/// The same at the vertices: how much farther than kSearched_m the nearest reading that counts is,
/// metres; negative where one is near, and no more than kSearched_m.
std::vector<double> beyond_search(const Run& run);
/// The same of any places and the readings that count.
std::vector<double> beyond_search(const Points& places, const std::vector<Vec3>& readings);

/// How much of the tissue's area there is, and how much of it that is.
struct SearchedArea {
  double whole_m2 = 0.0;
  double not_searched_m2 = 0.0;
};
SearchedArea searched_area(const Run& run);

/// Closed lines of these kinds, with cell arrays kind, part and hole.
VtpShape lines_of(const std::vector<Curve>& curves, const std::vector<std::string>& kinds);

}  // namespace palpation::results
