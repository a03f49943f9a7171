/// The picture of a run: what is believed, how sure that is, and what was missed or taken too much.
#pragma once

#include <string>

#include "draw/outcome.h"

namespace palpation::draw {

/// Three panels side by side, or one above the other where the tissue is much wider than high: the
/// mean with the touches; its standard deviation (or the acquisition where there is none); where
/// the boundary ends with its band and cut line, seen closer; where no band is known, with a truth
/// the margins, else the probability inside, else the mean. Returns the bytes of a PNG file, 1800
/// pixels wide if side by side. Throws IoError if the surface holds no field named mean, NoGraphics
/// if nothing can be drawn here.
std::string picture_of(const Outcome& outcome);

}  // namespace palpation::draw
