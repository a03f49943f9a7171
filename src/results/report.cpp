#include "results/report.h"

#include <vector>

#include "palpation/io/atomic_file.h"
#include "results/page.h"
#include "results/report_tables.h"
#include "results/sha256.h"
#include "results/view_data.h"
#include "results/web_parts.h"

namespace palpation::results {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uintmax_t kMostPicture_bytes = 20'000'000;

std::string hash_source(std::string_view code) {
  const auto digest = sha256(code);
  return "'sha256-" +
         base64(std::string_view(reinterpret_cast<const char*>(digest.data()), digest.size())) +
         "'";
}

/// Nothing from anywhere, and no script or style but these, to the byte.
std::string policy() {
  return "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; script-src " +
         hash_source(three_script()) + " " + hash_source(viewer_script()) + "; style-src " +
         hash_source(report_style());
}

std::string title_of(const Run& run) {
  const json& scene = run.told({"scene"});
  const fs::path path = scene.is_string() ? fs::path(scene.get<std::string>()) : run.folder;
  const std::string name = path.filename().string();
  return "Palpation" + (name.empty() ? "" : " of " + name);
}

std::string head_html(const Run& run) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy() +
         "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"referrer\" content=\"no-referrer\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n<title>" +
         escaped(title_of(run)) + "</title>\n<style>" + std::string(report_style()) +
         "</style>\n</head>\n<body>\n";
}

std::string verdict_html(const Run& run, const Origin& origin) {
  std::string html = "<header>\n<h1>" + escaped(title_of(run)) + "</h1>\n<p class=\"verdict\">" +
                     escaped(verdict_of(run, origin.state)) + "</p>\n";
  const json& warnings = run.told({"warnings"});
  if (warnings.is_array() && !warnings.empty()) {
    html += "<ul class=\"warnings\">\n";
    for (const json& warning : warnings)
      if (warning.is_string()) html += "<li>" + escaped(warning.get<std::string>()) + "</li>\n";
    html += "</ul>\n";
  }
  for (const std::string& sentence : scope_of(run))
    html += "<p class=\"scope\">" + escaped(sentence) + "</p>\n";
  return html + "</header>\n";
}

std::string choice(const std::string& value, const std::string& words, bool is_there,
                   bool is_first) {
  return std::string("<label") + (is_there ? "" : " class=\"off\"") +
         "><input type=\"radio\" name=\"field\" value=\"" + value + "\"" +
         (is_first ? " checked" : "") + (is_there ? "" : " disabled") + ">" + words + "</label>\n";
}

std::string box(const std::string& id, const std::string& words, bool is_there, bool is_on) {
  return std::string("<label") + (is_there ? "" : " class=\"off\"") +
         "><input type=\"checkbox\" id=\"show-" + id + "\"" +
         (is_on && is_there ? " checked" : "") + ">" + words + "</label>\n";
}

std::string viewer_html(const Run& run, const json& view) {
  const auto has_field = [&](const char* name) { return view["fields"].contains(name); };
  const auto has_line = [&](const char* kind) { return view["lines"].contains(kind); };
  const bool is_curved = run.tissue.field("chart_u") != nullptr;
  return "<section class=\"viewer\" aria-label=\"The tissue in 3-D\">\n<div class=\"stage\">"
         "<canvas id=\"tissue\" tabindex=\"0\" role=\"img\" aria-label=\"The tissue. Arrow keys "
         "turn it, plus and minus zoom, 0 shows all of it, square brackets go from batch to "
         "batch.\">"
         "</canvas><div id=\"labels\" class=\"labels\" aria-hidden=\"true\"></div>"
         "<div class=\"scale\"><span id=\"scale-words\"></span><i "
         "id=\"scale-line\"></i></div></div>\n"
         "<div class=\"panel\">\n<fieldset><legend>Colour</legend>\n" +
         choice("mean", "stiffness", true, true) +
         choice("stddev", "its standard deviation", has_field("stddev"), false) +
         choice("probability_inside", "probability of tumour", has_field("probability_inside"),
                false) +
         "<div id=\"colours\" class=\"colours\"></div><div class=\"ends\"><span id=\"colour-low\">"
         "</span><span id=\"colour-middle\"></span><span id=\"colour-high\"></span></div>"
         "</fieldset>\n<fieldset><legend>Show</legend>\n" +
         box("boundary", "boundary (black)", has_line("estimate"), true) +
         box("band", "its band (amber)", !view["bandScore"].is_null(), false) +
         box("cut", "cut line (purple, dashed)", has_line("cut"), false) +
         box("truth", "true boundary (green, dashed)", has_line("truth"), true) +
         box("unsearched", "what was not searched (hatched)", run.knows_touches, true) +
         box("touches", "touches", !view["touches"].empty(), true) +
         box("numbers", "numbers of this batch", !view["touches"].empty(), true) +
         box("tour", "way of the probe", !view["tours"].empty(), false) +
         box("shape", "shade the shape (shifts the colours)", is_curved, false) +
         "</fieldset>\n<fieldset><legend>Batch</legend>\n"
         "<input type=\"range\" id=\"batch\" min=\"0\" max=\"0\" value=\"0\" step=\"1\" "
         "aria-label=\"batch\">\n<output id=\"batch-words\" for=\"batch\"></output></fieldset>\n"
         "<p><button type=\"button\" id=\"closer\" aria-label=\"closer\">+</button> "
         "<button type=\"button\" id=\"farther\" aria-label=\"farther\">\u2212</button> "
         "<button type=\"button\" id=\"reset\">show all</button></p>\n"
         "<p id=\"picked\" class=\"picked\" role=\"status\">Click on the tissue for its values, on "
         "a touch for its reading.</p>\n</div>\n</section>\n";
}

std::string picture_html(const Run& run, const std::string& name, const std::string& words) {
  std::error_code none;
  const fs::path path = run.folder / name;
  const auto size = fs::file_size(path, none);
  if (none || size > kMostPicture_bytes) return "";
  return "<img src=\"data:image/png;base64," + base64(read_file(path)) + "\" alt=\"" + words +
         "\">\n";
}

std::string pictures_html(const Run& run) {
  std::string pictures =
      picture_html(run, "picture.png",
                   "estimated stiffness with touches, its standard deviation, the boundary and its "
                   "band") +
      picture_html(run, "convergence.png", "error and expected error from batch to batch");
  if (pictures.empty()) pictures = "<p>This run has no pictures.</p>\n";
  return "<section class=\"pictures\" aria-label=\"Pictures\">\n<p id=\"no-3d\" hidden>This "
         "browser does not draw the tissue in 3-D" +
         std::string(run.tissue.mesh.vertices.rows() > kMostVertices
                         ? ": it has more vertices than a page takes"
                         : "") +
         ".</p>\n<noscript><p>The tissue in 3-D needs the page's own script.</p></noscript>\n" +
         pictures + "</section>\n";
}

std::string text_of_key(const Run& run, const char* key) {
  const json& value = run.told({key});
  if (value.is_string()) return value.get<std::string>();
  return value.is_null() ? std::string("\u2013") : value.dump();
}

std::string row(const std::string& name, const std::string& html) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + html + "</td></tr>\n";
}

std::string inputs_html(const Run& run) {
  std::string html;
  const json& inputs = run.told({"inputs"});
  if (!inputs.is_array()) return html;
  for (const json& input : inputs) {
    if (!input.is_object()) continue;
    const auto word = [&](const char* key) {
      return input.contains(key) && input[key].is_string() ? input[key].get<std::string>()
                                                           : std::string();
    };
    html += row("read: " + escaped(word("file")),
                "<code>" + escaped(word("sha256")) + "</code> (SHA-256)");
  }
  return html;
}

std::string provenance_html(const Run& run, const Origin& origin) {
  std::string rows =
      row("scene", escaped(text_of_key(run, "scene"))) +
      row("seed", escaped(text_of_key(run, "seed"))) +
      row("made by", "palpate " + escaped(origin.version) +
                         (origin.command.empty() ? "" : ", " + escaped(origin.command)));
  if (!run.told({"stop_reason"}).is_null())
    rows += row("ended because", escaped(text_of_key(run, "stop_reason")));
  rows += inputs_html(run);
  rows += row("frame of the coordinates", escaped(name_of(run.frame()))) +
          row("chart", "<code>" + escaped(text_of_key(run, "chart_hash")) + "</code>");
  for (const char* name : {"surface.vtp", "boundary.vtp", "summary.json"}) {
    if (fs::exists(run.folder / name))
      rows += row(std::string("written: ") + name,
                  "<code>" + sha256_digits(read_file(run.folder / name)) + "</code> (SHA-256)");
  }
  std::string html = "<div class=\"wide\"><table>\n" + rows + "</table></div>\n";
  if (const json& options = run.told({"options"}); options.is_object())
    html += "<details><summary>All values of the scene</summary>\n<pre>" +
            escaped(options.dump(2, ' ', false, json::error_handler_t::replace)) +
            "</pre></details>\n";
  return html;
}

std::string section(const std::string& heading, const std::string& html) {
  return html.empty() ? "" : "<section>\n<h2>" + heading + "</h2>\n" + html + "</section>\n";
}

}  // namespace

std::string report_html(const Run& run, const Origin& origin) {
  const json view = view_data(run);
  return head_html(run) + verdict_html(run, origin) + viewer_html(run, view) + pictures_html(run) +
         section("Parts", parts_html(run)) + section("Figures", figures_html(run)) +
         section("Readings", readings_html(run)) +
         section("Where this comes from", provenance_html(run, origin)) +
         "<footer>For research on phantoms and excised tissue, not for patients. The 3-D view is "
         "made with three.js, \u00a9 2010\u20132026 three.js authors, MIT licence.</footer>\n"
         "<script type=\"application/json\" id=\"run-data\">" +
         inert(view.dump(-1, ' ', true, json::error_handler_t::replace)) + "</script>\n<script>" +
         std::string(three_script()) + "</script>\n<script>" + std::string(viewer_script()) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace palpation::results
