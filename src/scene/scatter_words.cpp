#include "scene/scatter_words.h"

#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kMoreScatter = 1.1;  // times, surely

}  // namespace

std::string scale_words(const Conclusion& conclusion) {
  if (conclusion.evidence.area_by_logarithms_m2)
    return "Whether readings or their logarithms are level beside an edge, these do not tell. By "
           "logarithms, with field.transform log, the outline would hold " +
           fixed(*conclusion.evidence.area_by_logarithms_m2 * 1e6, 0) + " mm2" +
           (conclusion.certainty ? "; the band holds both outlines." : ".");
  if (conclusion.scale() != ReadingScale::Log || conclusion.model.contrast.scale) return "";
  return "It is the readings' logarithms that scatter evenly: the outline lies between their "
         "plateaus. With field.transform none it lies farther in.";
}

std::string more_scatter_words(const Conclusion& conclusion) {
  const DrawnNumber& inside = conclusion.outlines->noise_inside;
  if (inside.least < kMoreScatter) return "";
  return "Readings scatter " + fixed(inside.mean, 1) + " times as much (" + fixed(inside.least, 1) +
         " to " + fixed(inside.most, 1) + ") on the tumour as beside it, and count for less there" +
         (conclusion.model.contrast.scale == ReadingScale::Raw
              ? ": field.transform auto asks whether their logarithms fit better."
              : ".");
}

}  // namespace palpation::tool
