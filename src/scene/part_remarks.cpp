#include "scene/part_remarks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpation/geometry/chart_place.h"
#include "scene/words.h"

namespace palpation::tool {
namespace {

/// Fewer readings follow each other in a part that is small by chance.
constexpr std::size_t kFewestAtOnce = 4;
/// A sensor that works is wrong for a quarter of the time at most.
constexpr std::size_t kOneInPart = 4;

std::string reaching_words(const std::vector<TumourPart>& parts) {
  const auto at_border = std::ranges::count_if(parts, &TumourPart::touches_border);
  if (at_border == 0) return "";
  const std::string of_all = " of " + std::to_string(parts.size());
  if (at_border > 1)
    return std::to_string(at_border) + of_all +
           " parts reach the border of the tissue, beyond which they may go on.";
  const auto part = std::ranges::find_if(parts, &TumourPart::touches_border);
  return "Part " + std::to_string(part - parts.begin() + 1) + of_all +
         " reaches the border of the tissue, beyond which it may go on.";
}

/// Another tissue, an organ's or what it is held by, has an edge, too.
std::string beside_words(const std::vector<TumourPart>& parts, const Conclusion& conclusion) {
  const Surface& surface = conclusion.belief.prior().surface();
  const std::vector<DoubtfulPart>& doubtful = conclusion.evidence.doubtful;
  const auto most = std::ranges::max_element(doubtful, {}, &DoubtfulPart::border_share);
  if (most == doubtful.end() || !most->is_along_border()) return "";
  const auto part = std::ranges::find_if(parts, [&](const TumourPart& one) {
    return contains(one.polygon, chart_place(surface, most->where));
  });
  const std::string which =
      part == parts.end() ? "What was found" : "Part " + std::to_string(part - parts.begin() + 1);
  return which + " takes " + fixed(100.0 * most->border_share, 0) +
         " % of the border of the tissue, as another tissue beside it would: whether it is tumour, "
         "the readings do not tell. If it is not, leave it out by surface.patch: a tumour within "
         "it is not told apart from it.";
}

/// In a line, however many: which is how probable stands beside each part.
std::string unsure_words(const std::vector<TumourPart>& parts) {
  std::size_t count = 0, last = 0;
  double least = 1.0, most = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].probability || *parts[i].probability >= kSure) continue;
    last = i;
    ++count;
    least = std::min(least, *parts[i].probability);
    most = std::max(most, *parts[i].probability);
  }
  if (count == 0) return "";
  const std::string of_all = " of " + std::to_string(parts.size());
  if (count == 1)
    return "Part " + std::to_string(last + 1) + of_all + " is tumour with probability " +
           percent(least) + " only.";
  const std::string range =
      percent(least) + (percent(most) == percent(least) ? "" : " to " + percent(most));
  return std::to_string(count) + of_all + " parts are tumour with probability " + range +
         " only, each.";
}

/// Those of a part, among all that count.
struct FeltInside {
  std::size_t count = 0;
  std::size_t first = 0, last = 0;            // as they were made
  std::size_t first_rank = 0, last_rank = 0;  // of those that count

  bool is_felt_once() const {
    return count >= kFewestAtOnce && last_rank - first_rank + 1 == count;
  }
};

FeltInside felt_inside(const TumourPart& part, const Surface& surface,
                       std::span<const Palpation> palpations) {
  FeltInside felt;
  std::size_t rank = 0;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    if (!counts(palpations[i])) continue;
    if (contains(part.polygon, chart_place(surface, palpations[i].where))) {
      if (felt.count++ == 0) felt.first = i, felt.first_rank = rank;
      felt.last = i, felt.last_rank = rank;
    }
    ++rank;
  }
  return felt;
}

/// What is wrong with a sensor for as long makes such parts, too; not of most that was felt.
std::string felt_once_words(const std::vector<TumourPart>& parts, const Surface& surface,
                            std::span<const Palpation> palpations) {
  const auto counting = static_cast<std::size_t>(std::ranges::count_if(palpations, counts));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const FeltInside felt = felt_inside(parts[i], surface, palpations);
    if (!felt.is_felt_once() || kOneInPart * felt.count > counting) continue;
    return "Part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) +
           " was felt once, by readings " + std::to_string(felt.first + 1) + " to " +
           std::to_string(felt.last + 1) +
           ", made one after the other: what a sensor does wrong for as long looks alike. Touch "
           "there again.";
  }
  return "";
}

/// What is soft inside of a tumour, and what it grew around, read alike.
std::string hole_words(const std::vector<TumourPart>& parts, const Surface& surface) {
  const PolygonWithHoles* around = nullptr;
  std::size_t holes = 0;
  for (const TumourPart& part : parts) {
    holes += part.polygon.holes.size();
    if (around == nullptr && !part.polygon.holes.empty()) around = &part.polygon;
  }
  if (around == nullptr) return "";
  const TumourPart first = measured(around->holes.front(), surface);
  return "The outline has " + counted(holes, "hole") + ", " + (holes > 1 ? "one " : "") + "of " +
         fixed(std::abs(first.area_m2) * 1e6, 0) + " mm2 around " +
         place_words(first.position_m, 1) +
         ": what reads like healthy tissue counts as such, also where it is the soft core of a "
         "tumour.";
}

}  // namespace

std::vector<std::string> part_remarks(const std::vector<TumourPart>& parts,
                                      const Conclusion& conclusion) {
  const Surface& surface = conclusion.belief.prior().surface();
  std::vector<std::string> remarks = {
      unsure_words(parts), felt_once_words(parts, surface, conclusion.palpations),
      reaching_words(parts), beside_words(parts, conclusion), hole_words(parts, surface)};
  std::erase(remarks, "");
  return remarks;
}

}  // namespace palpation::tool
