#include "scene/misfit_words.h"

#include <cmath>

#include "scene/words.h"

namespace palpation::tool {
namespace {

constexpr double kChainsApart = 1.0;  // standard deviations: chance makes less of fifty draws

std::string apart_words(double disagreement) {
  return "Two samplings of the outline have not come to one answer: their areas differ by " +
         fixed(disagreement, 1) +
         " standard deviations, so the band may be too narrow. More readings would settle it.";
}

std::string since_words(const Misfit& misfit) {
  return "From batch " + std::to_string(misfit.from_batch) + " on ";
}

std::string side_words(double amount, const std::string& more, const std::string& less) {
  return reading_text(std::abs(amount)) + " " + (amount > 0.0 ? more : less);
}

/// "0.5 higher than before", or of logarithms "1.65 times as high as before".
std::string raised_words(ReadingScale scale, double amount) {
  if (scale == ReadingScale::Log) return fixed(std::exp(amount), 2) + " times as high as before";
  return side_words(amount, "higher", "lower") + " than before";
}

std::string standing_out_words(ReadingScale scale, double amount) {
  if (scale == ReadingScale::Log)
    return "reads " + fixed(std::exp(amount), 2) + " times as much as tissue around it";
  return (amount > 0.0 ? "stands out by " : "reads less by ") + reading_text(std::abs(amount));
}

std::string words_of(const Surface& surface, ReadingScale scale, const Misfit& misfit) {
  switch (misfit.kind) {
    case MisfitKind::Zero:
      return since_words(misfit) + "readings lie " + raised_words(scale, misfit.amount) +
             ", wherever they are: set the sensor's zero again and touch anew, or take "
             "the earlier ones out.";
    case MisfitKind::Gain:
      return since_words(misfit) + "what stands out does so " + fixed(1.0 + misfit.amount, 2) +
             " times as much as before: the sensor or the contact has changed.";
    case MisfitKind::Moved:
      return "In or before batch " + std::to_string(misfit.from_batch) +
             " the tissue moved, or its registration did: readings since then fit it " +
             fixed(misfit.amount * 1e3, 1) + " mm from where it lay, shifted by " +
             place_words(misfit.moved_m, 1) +
             ". Register it again and touch anew, or take the readings before or since out: the "
             "outline is of both.";
    case MisfitKind::WeakerPart:
      return "Something else lies at " + place_words(surface.position(*misfit.where), 1) + ": it " +
             standing_out_words(scale, misfit.amount) +
             ", which the outline does not hold. Touch there.";
  }
  return "";
}

std::string zero_words(ReadingScale scale, const ZeroChange& change) {
  return "From batch " + std::to_string(change.batch) + ", reading " +
         std::to_string(change.number + 1) + ", on readings lie " +
         raised_words(scale, change.amount) +
         ", wherever they are: the sensor's zero has moved. That much is taken from "
         "them; set it again.";
}

}  // namespace

std::vector<std::string> misfit_words(const Conclusion& conclusion) {
  std::vector<std::string> words;
  for (const ZeroChange& change : conclusion.evidence.zero_changes)
    words.push_back(zero_words(conclusion.scale(), change));
  for (const Misfit& misfit : misfits(conclusion))
    words.push_back(words_of(conclusion.belief.prior().surface(), conclusion.scale(), misfit));
  if (conclusion.outlines && conclusion.outlines->disagreement > kChainsApart)
    words.push_back(apart_words(conclusion.outlines->disagreement));
  return words;
}

}  // namespace palpation::tool
