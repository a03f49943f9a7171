#include "results/shown.h"

#include "palpation/base/error.h"
#include "results/clip.h"
#include "results/parts.h"

namespace palpation::results {
namespace {

/// Told apart also by people who confuse red and green: bluish green, amber, grey, magenta.
constexpr std::array<double, 3> kTouched = {0.0, 0.62, 0.45};
constexpr std::array<double, 3> kSetAside = {0.96, 0.67, 0.08};
constexpr std::array<double, 3> kMissed = {0.5, 0.5, 0.5};
constexpr std::array<double, 3> kNext = {0.89, 0.0, 0.55};

std::string words_on(const Touch& touch, const std::string& unit) {
  std::string words = "batch " + std::to_string(touch.batch);
  if (touch.reading)
    words = "reading " + text_of(*touch.reading) + (unit.empty() ? "" : " " + unit) + ", " + words;
  if (touch.is_missed()) words += ", could not be touched";
  if (!touch.set_aside.empty()) words += ", set aside: " + touch.set_aside;
  return words;
}

template <typename Belongs>
NamedMarks marked(const Run& run, const std::string& name, const std::array<double, 3>& colour,
                  Belongs belongs) {
  NamedMarks list{name, colour, {}};
  for (const Touch& touch : run.touches)
    if (belongs(touch))
      list.marks.push_back(
          {std::to_string(touch.number), words_on(touch, run.reading_unit()), touch.place});
  return list;
}

}  // namespace

std::vector<NamedModel> models_of(const Run& run) {
  return {{"tissue", model_of(run.tissue, shown_fields())},
          {"tumour", tumour_of(run)},
          {"band", band_of(run)},
          {"not_searched", not_searched_of(run)},
          {"outline", lines_of(run.curves, {"estimate"})},
          {"band_lines", lines_of(run.curves, {"band_inner", "band_outer"})},
          {"cut_line", lines_of(run.curves, {"cut"})},
          {"true_outline", lines_of(run.curves, {"truth"})}};
}

std::vector<NamedMarks> marks_of(const Run& run, int first_stop) {
  std::vector<NamedMarks> lists;
  lists.push_back(marked(run, "touches", kTouched,
                         [](const Touch& touch) { return touch.counts() && touch.kind != "way"; }));
  lists.push_back(marked(run, "set_aside", kSetAside, [](const Touch& touch) {
    return !touch.set_aside.empty() && !touch.is_missed();
  }));
  lists.push_back(
      marked(run, "missed", kMissed, [](const Touch& touch) { return touch.is_missed(); }));
  NamedMarks& next = lists.emplace_back(NamedMarks{"next_stops", kNext, {}});
  for (const Vec3& place : run.next_stops)
    next.marks.push_back({std::to_string(first_stop + static_cast<int>(next.marks.size())),
                          "to be touched next", place});
  return lists;
}

}  // namespace palpation::results
