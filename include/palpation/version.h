/// Which palpation this is. The one place where the version is written: CMake and the wheel read it
/// here.
#pragma once

#define PALPATION_VERSION_MAJOR 0
#define PALPATION_VERSION_MINOR 1
#define PALPATION_VERSION_PATCH 0

/// 102030 for 10.20.30: `#if PALPATION_VERSION_NUMBER >= 200`.
#define PALPATION_VERSION_NUMBER \
  (PALPATION_VERSION_MAJOR * 10000 + PALPATION_VERSION_MINOR * 100 + PALPATION_VERSION_PATCH)

#define PALPATION_TEXT_OF_(x) #x
#define PALPATION_DOTTED_(major, minor, patch) \
  PALPATION_TEXT_OF_(major) "." PALPATION_TEXT_OF_(minor) "." PALPATION_TEXT_OF_(patch)

namespace palpation {

/// "0.1.0".
inline constexpr const char* kVersion =
    PALPATION_DOTTED_(PALPATION_VERSION_MAJOR, PALPATION_VERSION_MINOR, PALPATION_VERSION_PATCH);

}  // namespace palpation

#undef PALPATION_DOTTED_
#undef PALPATION_TEXT_OF_
