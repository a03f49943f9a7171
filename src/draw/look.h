/// The lines of a picture, shared by maps and legend.
#pragma once

#include "draw/sheet.h"

namespace palpation::draw {

inline constexpr LineStyle kEstimateLine{.width_px = 3.6, .colour = {0, 0, 0}};
inline constexpr LineStyle kEstimateHalo{.width_px = 5.6, .colour = kWhite};
inline constexpr LineStyle kMarginLine{.width_px = 1.1,
                                       .colour = {0, 0, 0}};  // thin, so that thin margins show
inline constexpr LineStyle kTruthHalo{.width_px = 5.0, .colour = kWhite, .dash_px = 10.0};
inline constexpr LineStyle kTruthLine{.width_px = 3.0, .colour = kTruthGreen, .dash_px = 10.0};
inline constexpr LineStyle kBandLine{.width_px = 1.5, .colour = {84, 84, 92}};
inline constexpr LineStyle kCutHalo{.width_px = 4.6, .colour = kWhite};
inline constexpr LineStyle kCutLine{.width_px = 2.6, .colour = kCutPurple};
inline constexpr LineStyle kRim{.width_px = 1.2, .colour = kGrey};
inline constexpr LineStyle kFrame{.width_px = 1.2, .colour = kGrey};

}  // namespace palpation::draw
