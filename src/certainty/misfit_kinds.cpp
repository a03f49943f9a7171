// What kinds of misfit are called, and from which evidence on one surprises.
#include <array>
#include <cmath>

#include "palpation/base/error.h"
#include "palpation/certainty/misfit.h"

namespace palpation {
namespace {

constexpr double kKinds = 6.0;  // zero, gain, place, parts, outlines, readings that come late

}  // namespace

std::string_view name_of(MisfitKind kind) {
  constexpr std::array<std::string_view, 9> kNames = {"zero",  "gain",  "moved",   "weaker", "tilt",
                                                      "waves", "drift", "outline", "late"};
  return kNames[static_cast<std::size_t>(kind)];
}

double surprising(double false_alarms) {
  require(false_alarms > 0.0 && false_alarms < 1.0, "misfits",
          "false_alarms = " + text_of(false_alarms), "must lie in (0, 1)");
  return std::log(kKinds / false_alarms);
}

}  // namespace palpation
