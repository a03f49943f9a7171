#include "scene/scatter_words.h"

#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kMoreScatter = 1.1;  // times, surely

}  // namespace

std::string scale_words(const Conclusion& conclusion) {
  const bool is_log = conclusion.scale() == ReadingScale::Log;
  if (conclusion.evidence.scale_is_open)
    return std::string(
               "Whether readings scatter evenly about an edge, or their logarithms do, these "
               "do not tell: the outline lies between plateaus of ") +
           (is_log ? "logarithms" : "readings") +
           ", and the band holds the other one, too. field.transform log or none decides it.";
  if (!is_log || conclusion.model.contrast.scale) return "";
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
