#include "results/report_tables.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "palpation/base/error.h"
#include "results/page.h"

namespace palpation::results {
namespace {

using nlohmann::json;

constexpr const char* kMm2 = "mm\u00b2";
constexpr std::size_t kMostRows = 5000;

std::string cell(const std::string& html) { return "<td>" + html + "</td>"; }
std::string number_cell(const std::string& html) {
  return "<td class=\"number\">" + html + "</td>";
}

/// Rows of a name and its value, those without a value left out.
class Figures {
 public:
  explicit Figures(const Run& run) : run_(run) {}

  void add(const std::string& name, std::initializer_list<const char*> keys, int digits,
           const std::string& unit) {
    const std::optional<double> value = run_.number(keys);
    if (!value) return;
    std::string path;
    for (const char* key : keys) path += (path.empty() ? "" : ".") + std::string(key);
    rows_ += std::exchange(heading_, "") + "<tr><th scope=\"row\">" + name + "</th>" +
             number_cell(shown(value, digits, path)) + cell(escaped(unit)) + "</tr>\n";
  }
  /// Left out, too, where nothing follows it.
  void add_heading(const std::string& words) {
    heading_ = "<tr><th scope=\"colgroup\" colspan=\"3\">" + words + "</th></tr>\n";
  }
  std::string html() const {
    return rows_.empty() ? "" : "<div class=\"wide\"><table>\n" + rows_ + "</table></div>\n";
  }

 private:
  const Run& run_;
  std::string heading_;
  std::string rows_;
};

std::string percent_words(const std::optional<double>& share) {
  return share ? rounded(100.0 * *share, 3) + " % " : std::string();
}

std::optional<double> number_of(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object.at(key).is_number())
    return std::nullopt;
  return object.at(key).get<double>();
}

std::string triple(const json& part, const char* key, std::size_t count) {
  if (!part.is_object() || !part.contains(key) || !part.at(key).is_array() ||
      part.at(key).size() < count)
    return "\u2013";
  std::string words;
  for (std::size_t i = 0; i < count; ++i) {
    const json& value = part.at(key).at(i);
    words += (i == 0 ? "" : ", ") +
             (value.is_number() ? rounded(value.get<double>(), 4) : std::string("\u2013"));
  }
  return words;
}

std::string words_on(const Touch& touch, const std::string& unit) {
  if (touch.is_missed()) return "could not be touched";
  if (!touch.reading) return "no reading";
  return rounded(*touch.reading, 5) + (unit.empty() ? "" : " " + unit);
}

std::string row_of(const Touch& touch, const Run& run) {
  const std::string why = touch.is_missed() ? std::string() : touch.set_aside;
  std::string row = "<tr id=\"reading-" + std::to_string(touch.number) + "\"" +
                    (touch.counts() ? "" : " class=\"aside\"") + " data-reading=\"" +
                    escaped(words_on(touch, run.reading_unit())) + "\"" +
                    (why.empty() ? "" : " data-why=\"" + escaped("set aside: " + why) + "\"") + ">";
  row += cell("<button type=\"button\" class=\"show-touch\" disabled>" +
              std::to_string(touch.number) + "</button>");
  row += number_cell(std::to_string(touch.batch)) + cell(escaped(touch.kind));
  row += number_cell(touch.is_missed() ? "\u2013" : shown(touch.reading, 5));
  for (const double coordinate : touch.place) row += number_cell(rounded(coordinate * 1e3, 5));
  return row + cell(escaped(why)) + "</tr>\n";
}

std::string aside_html(const Run& run) {
  std::string rows;
  std::size_t count = 0;
  for (const Touch& touch : run.touches) {
    if (touch.counts() || ++count > kMostRows) continue;
    const std::string number = std::to_string(touch.number);
    const bool is_listed = static_cast<std::size_t>(touch.number) <= kMostRows;
    rows += "<li>" +
            (is_listed ? "<a href=\"#reading-" + number + "\">Touch " + number + "</a>"
                       : "Touch " + number) +
            ": " +
            escaped(touch.is_missed()
                        ? "could not be touched"
                        : words_on(touch, run.reading_unit()) + ", set aside: " + touch.set_aside) +
            "</li>\n";
  }
  if (count == 0) return "<p>All readings count; none was set aside.</p>\n";
  return "<p>" + std::to_string(count) + (count == 1 ? " does" : " do") +
         " not count:</p>\n<ul class=\"aside\">\n" + rows + "</ul>\n";
}

}  // namespace

std::string figures_html(const Run& run) {
  const std::string unit = run.reading_unit().empty() ? "unit of the readings" : run.reading_unit();
  Figures figures(run);
  figures.add_heading("Found");
  figures.add("area of what was found", {"area_mm2"}, 4, kMm2);
  figures.add("level: tissue above it is tumour", {"level"}, 5, unit);
  figures.add("its standard deviation", {"level_sd"}, 2, unit);
  figures.add(percent_words(run.number({"band", "probability"})) + "band: mean half width",
              {"band", "half_width_mm"}, 3, "mm");
  figures.add("inside of the band", {"band", "inner_area_mm2"}, 4, kMm2);
  figures.add("band and what is inside", {"band", "outer_area_mm2"}, 4, kMm2);
  figures.add("inside of the cut line, beyond which the risk of tumour is at most " +
                  percent_words(run.number({"cut", "risk"})),
              {"cut", "area_mm2"}, 4, kMm2);
  figures.add("nothing is wider than", {"nothing_wider_than_mm"}, 3, "mm");
  figures.add("nothing else is wider than", {"no_other_wider_than_mm"}, 3, "mm");
  figures.add_heading("Expected to be wrong");
  figures.add("in all", {"expected_error_mm2"}, 3, kMm2);
  figures.add("missed", {"expected_missed_mm2"}, 3, kMm2);
  figures.add("extra", {"expected_extra_mm2"}, 3, kMm2);
  figures.add("besides, where nothing was touched", {"expected_untouched_mm2"}, 3, kMm2);
  if (run.told({"error"}).is_object()) {
    const json& truth = run.told({"truth_is"});
    figures.add_heading("Truly wrong, against " +
                        escaped(truth.is_string() ? truth.get<std::string>() : "the truth"));
    figures.add("in all", {"error", "symmetric_difference_mm2"}, 3, kMm2);
    figures.add("of the search area", {"error", "percent_of_search_area"}, 3, "%");
    figures.add("missed", {"error", "missed_mm2"}, 3, kMm2);
    figures.add("extra", {"error", "extra_mm2"}, 3, kMm2);
    figures.add("Dice coefficient", {"error", "dice"}, 4, "");
    figures.add("Hausdorff distance", {"error", "hausdorff_mm"}, 3, "mm");
    figures.add("mean distance of the boundaries", {"error", "mean_distance_mm"}, 3, "mm");
  }
  figures.add_heading("Effort");
  figures.add("readings", {"measurements"}, 9, "");
  figures.add("search area", {"search_area_mm2"}, 5, kMm2);
  figures.add("way of the probe", {"path_mm"}, 4, "mm");
  figures.add("length over which stiffness changes", {"learned", "length_mm"}, 3, "mm");
  figures.add("noise of a reading", {"learned", "noise_sd"}, 3, unit);
  return figures.html();
}

std::string parts_html(const Run& run) {
  const json& parts = run.told({"parts"});
  if (!parts.is_array() || parts.empty()) return "";
  std::string html =
      "<div class=\"wide\"><table>\n<thead><tr><th>part</th><th class=\"number\">area, "
      "mm\u00b2</th>"
      "<th class=\"number\">probability that it is there</th><th>middle x, y, z, mm</th>"
      "<th>extent laid flat, mm</th><th>reaches the border</th><th class=\"number\">holes</th></tr>"
      "</thead>\n<tbody>\n";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const json& part = parts[i];
    const bool reaches = part.is_object() && part.value("touches_border", json()) == json(true);
    const std::size_t holes = part.is_object() && part.contains("holes") ? part["holes"].size() : 0;
    const std::string key = "parts." + std::to_string(i) + ".";
    html += "<tr>" + cell(std::to_string(i + 1)) +
            number_cell(shown(number_of(part, "area_mm2"), 4, key + "area_mm2")) +
            number_cell(shown(number_of(part, "probability"), 3, key + "probability")) +
            cell(triple(part, "position_mm", 3)) + cell(triple(part, "extent_mm", 2)) +
            cell(reaches ? "yes" : "no") + number_cell(std::to_string(holes)) + "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string readings_html(const Run& run) {
  if (run.touches.empty())
    return run.knows_touches ? "<p>There are no readings.</p>\n"
                             : "<p>The readings of this run are lost.</p>\n";
  const std::string unit = run.reading_unit().empty() ? "" : ", " + escaped(run.reading_unit());
  std::string html = aside_html(run);
  const std::size_t listed = std::min(run.touches.size(), kMostRows);
  if (listed < run.touches.size())
    html += "<p>The first " + std::to_string(listed) + " of " + std::to_string(run.touches.size()) +
            ": the others are in the table of measurements beside this page.</p>\n";
  html +=
      "<div class=\"readings\" tabindex=\"0\" role=\"region\" aria-label=\"readings\"><table>\n"
      "<thead><tr><th>touch</th><th class=\"number\">batch</th><th>kind</th><th class=\"number\">"
      "reading" +
      unit +
      "</th><th class=\"number\">x, mm</th><th class=\"number\">y, mm</th><th class=\"number\">z, "
      "mm</th><th>set aside because</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < listed; ++i) html += row_of(run.touches[i], run);
  return html + "</tbody>\n</table></div>\n";
}

}  // namespace palpation::results
