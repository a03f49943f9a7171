/// What of a report does not change from run to run: script and style, from src/draw/report/.
#pragma once

#include <string_view>

namespace palpation::results {

std::string_view three_script();   ///< three.js with OrbitControls and fat lines, bundled
std::string_view viewer_script();  ///< viewer.js
std::string_view report_style();   ///< report.css

}  // namespace palpation::results
