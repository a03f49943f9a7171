#include "draw/caption.h"

#include "draw/axis.h"

namespace palpation::draw {
namespace {

constexpr const char* kSquareMm = " mm\u00b2";

/// Less than a thousandth of a square micrometre is rounding.
std::string short_area(double mm2) { return short_number(mm2 < 1e-9 ? 0.0 : mm2, 2); }

std::string readings_text(const Outcome& outcome) {
  const double count =
      outcome.summary.measurements.value_or(static_cast<double>(outcome.touches.size()));
  return short_number(count, 7) + (count == 1.0 ? " reading" : " readings");
}

std::string ruled_out_text(const RuledOut& ruled_out) {
  std::string text = "no tumour wider than " + short_number(ruled_out.diameter_mm, 3) + " mm";
  if (ruled_out.probability)
    text += ", with probability " + short_number(100.0 * *ruled_out.probability, 3) + " %";
  return text;
}

std::string error_text(const ErrorNumbers& error) {
  std::string text;
  if (error.symmetric_difference_mm2)
    text += "Error " + short_number(*error.symmetric_difference_mm2, 3) + kSquareMm;
  if (error.missed_mm2 && error.extra_mm2 && !text.empty())
    text += ", " + short_area(*error.missed_mm2) + " missed and " + short_area(*error.extra_mm2) +
            " extra";
  if (error.percent_of_search_area && !text.empty())
    text += " (" + short_number(*error.percent_of_search_area, 2) + " % of the search area)";
  if (error.dice && text.empty()) text += "Dice " + short_number(*error.dice, 3);
  return text;
}

}  // namespace

std::string caption_of(const Outcome& outcome) {
  constexpr const char* kBetween = "   \u00b7   ";
  const Summary& summary = outcome.summary;
  std::string caption = readings_text(outcome);
  if (summary.ruled_out)
    return caption + kBetween + "nothing found" + kBetween + ruled_out_text(*summary.ruled_out);
  if (summary.error) {
    const std::string error = error_text(*summary.error);
    if (!error.empty()) caption += kBetween + error;
  }
  if (summary.expected_error_mm2)
    caption += std::string(kBetween) + "expected error " +
               short_number(*summary.expected_error_mm2, 3) + kSquareMm;
  if (summary.area_mm2)
    caption += std::string(kBetween) + "tumour " + short_number(*summary.area_mm2, 4) + kSquareMm;
  if (summary.level) caption += std::string(kBetween) + "level " + short_number(*summary.level, 4);
  return caption;
}

}  // namespace palpation::draw
