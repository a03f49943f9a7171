/// Measurements that could do harm, and what must come of each: the rows S01 to S20 of the
/// catalogue of bad measurements.
///
/// They lie on a flat square of 20 x 20 mm in the plane z = 0, one corner at the origin, cut in two
/// along the diagonal from there. Free of any test framework, so that the texts also serve as seeds
/// for a fuzzer.
#pragma once

#include <string>
#include <vector>

namespace palpation::catalogue {

struct MeasurementCase {
  std::string row;   ///< "S01" to "S20"; "CSV" for what any table must be
  std::string name;  ///< what is odd about it
  std::string text;  ///< the bytes of the file
  std::vector<std::string>
      refused_with{};  ///< what the error says, behind the file's name; empty: the file is read
  int rows = 0;        ///< how many measurements were read
  int places = 0;      ///< and at how many places
  std::vector<std::string> warned_with{};  ///< what the warnings say, one each, in order
};

const std::vector<MeasurementCase>& measurement_cases();

/// A row that no file shows, or that other tests take further.
struct MeasurementRowElsewhere {
  std::string row, reason;
};
const std::vector<MeasurementRowElsewhere>& measurement_rows_elsewhere();

}  // namespace palpation::catalogue
