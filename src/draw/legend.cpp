#include "draw/legend.h"

#include <algorithm>

#include "draw/axis.h"
#include "draw/look.h"

namespace palpation::draw {
namespace {

constexpr double kGap_px = 38.0;
constexpr double kBeforeWords_px = 10.0;
constexpr TextStyle kWords{.size_px = 18.0};

std::vector<LegendEntry> entries_of(const Outcome& outcome) {
  std::vector<LegendEntry> entries;
  if (outcome.has_curve("estimate")) entries.push_back({"estimated boundary", {kEstimateLine}, {}});
  if (outcome.has_curve("truth")) entries.push_back({outcome.summary.truth_line, {kTruthLine}, {}});
  if (outcome.has_curve("cut") && outcome.shows_band()) {
    const std::string risk =
        outcome.summary.cut_risk
            ? " (" + short_number(100.0 * *outcome.summary.cut_risk, 3) + " % risk)"
            : "";
    entries.push_back({"cut line" + risk, {kCutLine}, {}});
  }
  if (!outcome.shows_band() && (outcome.has_curve("band_inner") || outcome.has_curve("band_outer")))
    entries.push_back({"confidence band", {kBandLine}, {}});
  const auto add_touch = [&](const Touch& example, const std::string& words, auto&& belongs) {
    const bool occurs = std::any_of(outcome.touches.begin(), outcome.touches.end(), belongs);
    if (occurs) entries.push_back({words, {}, look_of(example, /*radius_px=*/6.5)});
  };
  add_touch({.initial = true}, "initial samples", [](const Touch& t) {
    return t.initial && !t.set_aside && !t.on_the_way && !t.planned;
  });
  add_touch({}, "adaptive samples", [](const Touch& t) {
    return !t.initial && !t.set_aside && !t.on_the_way && !t.planned;
  });
  add_touch({.on_the_way = true}, "in-transit readings",
            [](const Touch& t) { return t.on_the_way && !t.set_aside; });
  add_touch({.planned = true}, "next samples, by their index",
            [](const Touch& t) { return t.planned; });
  add_touch({.set_aside = true}, "set aside", [](const Touch& t) { return t.set_aside; });
  if (!outcome.is_searched())
    entries.push_back({.words = "not searched", .lines = {}, .touch = {}, .hatched = true});
  return entries;
}

double sample_width_px(const LegendEntry& entry) {
  return entry.touch ? 16.0 : entry.hatched ? 30.0 : 66.0;
}

double width_px(const LegendEntry& entry) {
  return sample_width_px(entry) + kBeforeWords_px + text_width_px(entry.words, kWords);
}

double width_px(const std::vector<LegendEntry>& row) {
  double width = row.empty() ? 0.0 : kGap_px * static_cast<double>(row.size() - 1);
  for (const LegendEntry& entry : row) width += width_px(entry);
  return width;
}

void draw_entry(Sheet& sheet, const Pixel& place, const LegendEntry& entry) {
  const double sample = sample_width_px(entry);
  for (const LineStyle& line : entry.lines) sheet.line(place, place + Pixel(sample, 0.0), line);
  if (entry.hatched) {
    const Box patch{place.x(), place.y() - 9.0, sample, 18.0};
    sheet.fill(patch, kPaleGrey);
    for (double x = 6.0; x < patch.width + patch.height; x += 8.0)
      sheet.line(
          {patch.left + std::min(x, patch.width), patch.bottom + std::max(0.0, x - patch.width)},
          {patch.left + std::max(0.0, x - patch.height), patch.bottom + std::min(x, patch.height)},
          {.width_px = 1.3, .colour = kGrey});
  }
  if (entry.touch) {
    const Pixel centre = place + Pixel(sample / 2.0, 0.0);
    sheet.disc(centre, entry.touch->radius_px + 1.0, kGrey);
    sheet.disc(centre, entry.touch->radius_px, entry.touch->rim);
    sheet.disc(centre, entry.touch->radius_px * entry.touch->core_share, entry.touch->core);
  }
  sheet.text(place + Pixel(sample + kBeforeWords_px, 0.0), entry.words, kWords);
}

}  // namespace

std::vector<std::vector<LegendEntry>> legend_rows(const Outcome& outcome, double most_px) {
  std::vector<std::vector<LegendEntry>> rows;
  for (const LegendEntry& entry : entries_of(outcome)) {
    const bool fits = !rows.empty() && width_px(rows.back()) + kGap_px + width_px(entry) <= most_px;
    if (!fits) rows.emplace_back();
    rows.back().push_back(entry);
  }
  return rows;
}

void draw_legend(Sheet& sheet, const std::vector<std::vector<LegendEntry>>& rows,
                 double bottom_px) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double height = bottom_px + kLegendRow_px * (static_cast<double>(rows.size() - i) - 0.5);
    Pixel place((sheet.width_px() - width_px(rows[i])) / 2.0, height);
    for (const LegendEntry& entry : rows[i]) {
      draw_entry(sheet, place, entry);
      place.x() += width_px(entry) + kGap_px;
    }
  }
}

}  // namespace palpation::draw
