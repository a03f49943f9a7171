/// What sessions differ by, in words.
#pragma once

#include <string>
#include <vector>

#include "scene/episode.h"

namespace palpation::tool {

/// "2nd session" of that which the files number 1.
std::string session_name(int session);

/// "0.5 higher than before", or of logarithms "1.65 times as high as before".
std::string raised_words(ReadingScale scale, double amount);

/// A sentence each, of those whose zero or gain is surely another; that they are taken for
/// one, or that some are short.
std::vector<std::string> session_words(const Conclusion& conclusion);

}  // namespace palpation::tool
