/// The result in one line, at the foot of a picture.
#pragma once

#include <string>

#include "draw/outcome.h"

namespace palpation::draw {

std::string caption_of(const Outcome& outcome);

}  // namespace palpation::draw
