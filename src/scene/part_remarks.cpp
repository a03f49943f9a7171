#include "scene/part_remarks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/words.h"

namespace palpation::tool {
namespace {

/// A tumour seldom lies along so much of it.
constexpr double kMuchBorder = 1.0 / 3.0;
constexpr std::size_t kPartsTold = 4;

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
std::string beside_words(const std::vector<TumourPart>& parts) {
  const auto most = std::ranges::max_element(parts, {}, &TumourPart::border_share);
  if (most == parts.end() || most->border_share < kMuchBorder) return "";
  return "Part " + std::to_string(most - parts.begin() + 1) + " takes " +
         fixed(100.0 * most->border_share, 0) +
         " % of the border of the tissue, as another tissue beside it would: whether it is tumour, "
         "the readings do not tell. If it is not, leave it out by surface.patch: a tumour within "
         "it is "
         "not told apart from it.";
}

/// One by one, or in a line where these are many.
std::vector<std::string> unsure_words(const std::vector<TumourPart>& parts) {
  std::vector<std::string> words;
  double least = 1.0, most = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].probability || *parts[i].probability >= kSure) continue;
    least = std::min(least, *parts[i].probability);
    most = std::max(most, *parts[i].probability);
    words.push_back("Part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) +
                    " is tumour with probability " + percent(*parts[i].probability) + " only.");
  }
  if (words.size() <= kPartsTold) return words;
  return {std::to_string(words.size()) + " of " + std::to_string(parts.size()) +
          " parts are tumour with a probability of " + percent(least) + " to " + percent(most) +
          " only, each."};
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
                                      const Surface& surface) {
  std::vector<std::string> remarks = unsure_words(parts);
  for (std::string words : {reaching_words(parts), beside_words(parts), hole_words(parts, surface)})
    remarks.push_back(std::move(words));
  std::erase(remarks, "");
  return remarks;
}

}  // namespace palpation::tool
