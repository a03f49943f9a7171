// Includes the library from its sources, and holds its version against what the build says.
#include <palpation/palpation.h>

#include <string_view>

static_assert(PALPATION_VERSION_NUMBER == PALPATION_VERSION_MAJOR * 10000 +
                                              PALPATION_VERSION_MINOR * 100 +
                                              PALPATION_VERSION_PATCH);
static_assert(std::string_view(palpation::kVersion) == EXPECTED_VERSION);

int main() { return palpation::Region().empty() ? 0 : 1; }
