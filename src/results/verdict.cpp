#include "results/verdict.h"

#include <algorithm>
#include <array>

#include "results/page.h"
#include "results/parts.h"

namespace palpation::results {
namespace {

using nlohmann::json;

constexpr const char* kMm2 = " mm\u00b2";
constexpr double kMm2PerM2 = 1e6;

std::string percent(double share) { return rounded(100.0 * share, share < 0.1 ? 2 : 3) + " %"; }

std::string count_words(std::size_t count) {
  constexpr std::array<const char*, 5> kWords = {"No", "One", "Two", "Three", "Four"};
  return count < kWords.size() ? kWords[count] : std::to_string(count);
}

std::string nothing_words(const Run& run) {
  if (run.number({"measurements"}).value_or(0.0) == 0.0)
    return "Nothing was felt yet, so nothing is known.";
  const std::optional<double> widest = run.number({"nothing_wider_than_mm"});
  if (!widest) return "No tumour was found, but these readings rule none out.";
  return "No tumour was found. With a probability of " +
         percent(run.number({"options", "band", "probability"}).value_or(0.95)) +
         " there is none that is wider than " + rounded(*widest, 3) + " mm.";
}

std::string found_words(const Run& run, const json& parts) {
  const std::string area = rounded(run.number({"area_mm2"}).value_or(0.0), 3) + kMm2;
  std::string words = count_words(parts.size());
  words += parts.size() == 1 ? " tumour of " + area + " was found"
                             : " tumours were found, " + area + " in all";
  if (const std::optional<double> expected = run.number({"expected_error_mm2"}))
    words += "; " + rounded(*expected, 2) + kMm2 + " are expected to be wrong";
  return words + ".";
}

bool touches_border(const json& part) {
  return part.is_object() && part.value("touches_border", json()) == json(true);
}

std::string border_words(const json& parts) {
  const auto reaching = std::ranges::count_if(parts, touches_border);
  if (parts.empty()) return "";
  if (reaching == 0)
    return parts.size() == 1
               ? "It lies within the tissue that was given: its border is not reached."
               : "They lie within the tissue that was given: its border is not "
                 "reached.";
  const std::string subject = parts.size() == 1 ? "It reaches"
                              : reaching == static_cast<std::ptrdiff_t>(parts.size())
                                  ? "All reach"
                                  : count_words(static_cast<std::size_t>(reaching)) +
                                        (reaching == 1 ? " of them reaches" : " of them reach");
  return subject + " the border of the tissue: how far beyond is not known.";
}

}  // namespace

std::string verdict_of(const Run& run, const RunState& state) {
  if (run.summary.is_null())
    return "This run did not end" +
           (state.empty() || state == "complete" ? "" : " (" + state + ")") +
           ": this is what was believed after its last batch, and nothing is concluded from it.";
  const json& parts = run.told({"parts"});
  return parts.is_array() && !parts.empty() ? found_words(run, parts) : nothing_words(run);
}

std::vector<std::string> scope_of(const Run& run) {
  std::vector<std::string> sentences;
  const auto [whole, missing] = searched_area(run);
  const std::string near = rounded(kSearched_m * 1e3, 1) + " mm";
  if (!run.knows_touches) {
    sentences.emplace_back(
        "How much of the tissue was searched is not known: its readings are lost.");
  } else if (missing <= 1e-6 * whole) {
    sentences.push_back("All of the tissue was searched: no place is farther than " + near +
                        " from a reading that counts.");
  } else {
    sentences.push_back(percent(missing / whole) + " of the tissue (" +
                        rounded(missing * kMm2PerM2, 3) + kMm2 +
                        ") was not searched: no reading that counts is within " + near + ".");
  }
  const json& parts = run.told({"parts"});
  if (parts.is_array() && !parts.empty()) sentences.push_back(border_words(parts));
  if (!run.next_stops.empty())
    sentences.push_back(std::to_string(run.next_stops.size()) +
                        (run.next_stops.size() == 1 ? " stop is" : " stops are") +
                        " planned next, and shown in magenta.");
  return sentences;
}

}  // namespace palpation::results
