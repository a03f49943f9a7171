/// What a run found, in words: first of all what a person must know.
#pragma once

#include <string>
#include <vector>

#include "results/run.h"

namespace palpation::results {

/// How a run ended, by its record: "complete", "interrupted", ...; empty where there is none.
using RunState = std::string;

/// One sentence, or two: whether a tumour was found, how large, and what of that is expected to be
/// wrong. Plain text.
std::string verdict_of(const Run& run, const RunState& state);

/// How much was not searched, and whether what was found reaches the border, a sentence each.
std::vector<std::string> scope_of(const Run& run);

}  // namespace palpation::results
