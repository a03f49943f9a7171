/// The tables of a report, as HTML.
#pragma once

#include <string>

#include "results/run.h"

namespace palpation::results {

/// What was found, how far it may be off, and how far it is where a truth is known.
std::string figures_html(const Run& run);
/// Each part by itself; empty where there is none.
std::string parts_html(const Run& run);
/// First those that are set aside, with the reason, then all.
std::string readings_html(const Run& run);

}  // namespace palpation::results
