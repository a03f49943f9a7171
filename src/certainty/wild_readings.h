/// Readings that tell nothing, as outlines and scales have them.
#pragma once

namespace palpation {

/// Their part of all readings is Beta's, as if so many of each kind had been seen beforehand.
inline constexpr int kWildBefore = 1, kTellingBefore = 99;
inline constexpr double kWildPart =
    static_cast<double>(kWildBefore) / (kWildBefore + kTellingBefore);

/// Over so many times the range of the others they lie anywhere.
inline constexpr double kWildRanges = 3.0;

}  // namespace palpation
