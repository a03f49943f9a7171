// What came of a robot's log, as tables.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "palpation/io/robot_log.h"

namespace palpation {
namespace {

constexpr double kLeastVariance = 1e-60;  // as measurements allow: below, it is none

std::string number_text(double value) { return std::isfinite(value) ? text_of(value) : ""; }

/// Empty for all three where a direction is not known.
std::array<std::string, 3> direction_text(const Vec3& direction) {
  if (direction.isZero(0.0)) return {};
  return {text_of(direction.x()), text_of(direction.y()), text_of(direction.z())};
}

std::string variance_text(double variance) {
  return variance < kLeastVariance ? "0" : number_text(variance);
}

}  // namespace

std::string probed_csv(const ProbedLog& result) {
  std::string text =
      "x,y,z,reading,noise_variance,batch,kind,tx,ty,tz,set_aside,t,session,withdrawn,"
      "reading_unit,nx,ny,nz,contact,probing,line\n";
  for (const Probed& probed : result.probed) {
    if (!probed.reason.empty() && !probed.is_missed) continue;
    const auto travel = direction_text(probed.travel), normal = direction_text(probed.normal);
    const bool is_stop = probed.contact != "sliding";
    text += csv_line(std::vector<std::string>{number_text(probed.place_m.x()),
                                              number_text(probed.place_m.y()),
                                              number_text(probed.place_m.z()),
                                              number_text(probed.reading),
                                              variance_text(probed.noise_variance),
                                              "0",
                                              probed.is_missed ? "missed"
                                              : is_stop        ? "stop"
                                                               : "way",
                                              travel[0],
                                              travel[1],
                                              travel[2],
                                              "",
                                              number_text(probed.time_s),
                                              probed.session,
                                              "",
                                              result.unit,
                                              normal[0],
                                              normal[1],
                                              normal[2],
                                              probed.contact,
                                              probed.probing,
                                              std::to_string(probed.line)});
  }
  return text;
}

std::string left_out_csv(const ProbedLog& result) {
  std::string text = "x,y,z,t,session,probing,line,kind,reason\n";
  for (const Probed& probed : result.probed) {
    if (probed.reason.empty()) continue;
    text += csv_line(std::vector<std::string>{
        number_text(probed.place_m.x()), number_text(probed.place_m.y()),
        number_text(probed.place_m.z()), number_text(probed.time_s), probed.session, probed.probing,
        std::to_string(probed.line), probed.is_missed ? "missed" : "", probed.reason});
  }
  return text;
}

}  // namespace palpation
