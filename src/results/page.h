/// A page in HTML, piece by piece: whatever a text holds, it is shown and never acted on.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palpation::results {

/// With & < > " and ' as references; bytes that are no UTF-8, and control characters, as the mark
/// for what cannot be shown.
std::string escaped(std::string_view text);

/// JSON that stands in a <script> and cannot end it.
std::string inert(std::string json);

/// A number for people, with its exact value beside it: <data value="122.70580">123</data>. A dash
/// where there is none.
std::string shown(const std::optional<double>& value, int digits, const std::string& key = "");

/// The same digits without a tag; plain decimals, no exponent.
std::string rounded(double value, int digits);

}  // namespace palpation::results
