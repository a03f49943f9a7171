// What is said where nothing was found.
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "readings/readings.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

/// Why what is highest is no tumour, and where it might be one all the same.
std::string without_edge_words(const std::optional<EdgeOdds>& of_edge) {
  if (!of_edge)
    return ", and no edge fits them: touch there again. Where it is a tumour all the same";
  const std::string less_probable =
      "a tumour's edge makes them less probable by a factor of e^" + fixed(-of_edge->log_odds, 0);
  if (of_edge->errors.readings > 0.0)
    return ", but readings that were made one after the other err alike, as a drifting sensor or "
           "its filter makes them, and " +
           less_probable + ". Where it is a tumour all the same";
  if (of_edge->wave_length_m == 0.0)
    return ", but scatter over it as healthy tissue of uneven stiffness or noise does, and " +
           less_probable + ". Where it is a tumour all the same";
  return ", as slowly as healthy tissue may, and " + less_probable +
         ". Where a tumour may lie so deep";
}

/// Where the field is highest, and why that is no tumour.
std::string no_edge_words(const Exploration& exploration) {
  const Conclusion& conclusion = exploration.conclusion();
  if (conclusion.belief.site_count() == 1)
    return "Nothing found: all readings were made at one place, and tell of no other.";
  Eigen::Index highest = 0;
  const double most = as_reading(conclusion.scale(), conclusion.component.mean.maxCoeff(&highest)),
               least = as_reading(conclusion.scale(), conclusion.component.mean.minCoeff());
  return "Nothing found that has an edge: readings rise by " + reading_text(most - least) +
         ", most around " +
         place_words(exploration.surface().vertex(static_cast<int>(highest)), 1) +
         without_edge_words(conclusion.evidence.of_edge) +
         ", level.estimate range draws where half of that is reached.";
}

/// Of readings that do not differ by more than noise may.
std::string no_contrast_words(const Exploration& exploration) {
  const std::vector<Palpation>& all = exploration.conclusion().palpations;
  const Palpation* greatest = nullptr;
  for (const Palpation& one : all) {
    if (counts(one) && (greatest == nullptr || one.reading > greatest->reading)) greatest = &one;
  }
  const std::string words = "Nothing found: the readings show no contrast that is surely no noise";
  if (greatest == nullptr) return words + ".";
  return words + "; the greatest is " +
         reading_words(greatest->reading, exploration.surface().position(greatest->where)) +
         ". Tissue that is stiff throughout, as far as it was touched, reads alike.";
}

}  // namespace

std::string weaker_words(const Exploration& exploration) {
  std::string words;
  for (const WeakerPart& part : exploration.conclusion().evidence.weaker)
    words += (words.empty() ? "" : ", ") + reading_text(part.contrast) + " around " +
             place_words(exploration.surface().position(part.where), 1);
  return "what stands out by less is " + words;
}

std::string instead_of_edge(const EdgeOdds& odds) {
  if (odds.errors.readings > 0.0) return "Noise that lasts from reading to reading";
  return odds.wave_length_m > 0.0 ? "Healthy tissue that waves"
                                  : "Noise, or tissue that is uneven,";
}

std::string no_level_words(const Exploration& exploration) {
  if (exploration.conclusion().evidence.trend_is_missing) return kTooFewForTrend;
  if (!exploration.conclusion().evidence.weaker.empty())
    return "Nothing found that stands out by plan.min_contrast: " + weaker_words(exploration) + ".";
  const std::vector<double> readings = used_readings(exploration.conclusion().palpations);
  if (readings.size() > 1 && all_equal(readings))
    return "Nothing found: all " + std::to_string(readings.size()) + " readings are equal, " +
           reading_text(readings.front()) + ", to the last digit, as if the sensor were stuck.";
  const Evidence& evidence = exploration.conclusion().evidence;
  const bool has_contrast = readings.size() > 1 && evidence.contrast_seen &&
                            exploration.conclusion().model.needs_contrast();
  if (evidence.of_edge || has_contrast) return no_edge_words(exploration);
  return readings.size() == 1 ? "Nothing found: one reading tells of no contrast."
                              : no_contrast_words(exploration);
}

}  // namespace palpation::tool
