// palpate-draw: pictures from the files of a run.
//
//   palpate-draw OUT_DIR                       reads surface.vtp, boundary.vtp, readings_used.csv
//   or measurements.csv, trace.csv and summary.json in OUT_DIR, writes picture.png
//                                              and, if the trace has at least two rows,
//                                              convergence.png beside them
//   palpate-draw OUT_DIR... --figure FILE      draws panels of these runs into a .png, .svg or .pdf
//   palpate-draw --curves CURVES.csv OUT.png   draws curves with standard errors: first column x,
//   then `name` and optionally `name_se` for each curve
//
// Exit codes: 0 done; 2 wrong usage; 3 a file is missing or malformed; 4 nothing can be drawn or
// written here.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "draw/chart.h"
#include "draw/figure.h"
#include "draw/offscreen.h"
#include "draw/outcome.h"
#include "draw/picture.h"
#include "draw/unroll.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "scene/add_to_run.h"
#include "scene/single_file.h"

namespace {

using namespace palpation;
using namespace palpation::draw;
namespace fs = std::filesystem;

constexpr int kWrongUsage = 2;
constexpr int kInputAtFault = 3;
constexpr int kMachineAtFault = 4;

struct Wish {
  std::vector<std::string> paths;
  bool curves = false;
  std::string title, x_label, y_label;
  bool logarithmic_y = false;
  std::string spread = "bars";
  int width_px = 1100;
  int height_px = 760;
  bool overwrite = false;
};

struct FigureWish {
  std::string file;
  std::vector<std::string> panels;
  double width_mm = 180.0;
  double dots_per_inch = 300.0;
  std::vector<double> limits, stddev_limits;
};

/// By the names that `palpate draw` gives them.
Panel panel_of(const std::string& name) {
  return name == "stddev" ? Panel::Uncertainty : name == "boundary" ? Panel::Boundary : Panel::Mean;
}

std::optional<results::Limits> limits_of(const std::vector<double>& pair) {
  if (pair.size() != 2) return std::nullopt;
  return results::Limits{pair[0], pair[1]};
}

void draw_figure(const std::vector<std::string>& runs, const FigureWish& wish,
                 tool::Existing figure) {
  std::vector<Outcome> outcomes;
  std::vector<std::string> names;
  for (const std::string& path : runs) {
    outcomes.push_back(unrolled_where_folded(read_outcome(path)));
    names.push_back((fs::path(path) / "").parent_path().filename().string());
  }
  FigureOptions options;
  options.width_mm = wish.width_mm;
  options.dots_per_inch = wish.dots_per_inch;
  options.colours = {limits_of(wish.limits), limits_of(wish.stddev_limits)};
  const fs::path file = wish.file;
  options.format = file.extension() == ".svg"   ? Format::Svg
                   : file.extension() == ".pdf" ? Format::Pdf
                                                : Format::Png;
  if (!wish.panels.empty()) {
    options.panels.clear();
    for (const std::string& name : wish.panels) options.panels.push_back(panel_of(name));
  }
  tool::refuse_to_replace(file, figure);
  write_atomically(file, figure_of(outcomes, names, options));
}

void draw_outcome(const fs::path& folder, tool::Existing pictures) {
  const Outcome outcome = unrolled_where_folded(read_outcome(folder));
  std::map<std::string, std::string> contents{{"picture.png", picture_of(outcome)}};
  const std::optional<Chart> chart =
      outcome.trace ? convergence_of(*outcome.trace) : std::optional<Chart>();
  if (chart) contents["convergence.png"] = picture_of(*chart);
  tool::add_to_run(folder, contents, pictures);
}

void draw_curves(const Wish& wish, tool::Existing picture) {
  Chart chart = chart_of(Table(wish.paths[0]));
  chart.title = wish.title;
  if (!wish.x_label.empty()) chart.x_label = wish.x_label;
  chart.y_label = wish.y_label;
  chart.logarithmic_y = wish.logarithmic_y;
  chart.spread = wish.spread == "band"   ? Spread::Band
                 : wish.spread == "none" ? Spread::None
                                         : Spread::Bars;
  chart.width_px = wish.width_px;
  chart.height_px = wish.height_px;
  tool::refuse_to_replace(wish.paths[1], picture);
  write_atomically(fs::path(wish.paths[1]), picture_of(chart));
}

int fulfil(const Wish& wish, const FigureWish& figure) {
  const std::size_t paths_wanted = wish.curves ? 2 : 1;
  if (figure.file.empty() && wish.paths.size() != paths_wanted) {
    std::fprintf(
        stderr, "palpate-draw: %s\n",
        wish.curves ? "--curves takes a table and the picture to write" : "give one output folder");
    return kWrongUsage;
  }
  silence_graphics_libraries();
  const tool::Existing pictures = wish.overwrite ? tool::Existing::Replaced : tool::Existing::Kept;
  if (!figure.file.empty()) {
    draw_figure(wish.paths, figure, pictures);
  } else if (wish.curves) {
    draw_curves(wish, pictures);
  } else {
    draw_outcome(wish.paths[0], pictures);
  }
  return 0;
}

int fulfil_or_explain(const Wish& wish, const FigureWish& figure) {
  const auto explain = [](const std::exception& error, int code) {
    std::fprintf(stderr, "palpate-draw: %s\n", error.what());
    return code;
  };
  try {
    return fulfil(wish, figure);
  } catch (const NoGraphics& error) {
    return explain(error, kMachineAtFault);
  } catch (const WriteError& error) {
    return explain(error, kMachineAtFault);
  } catch (const Error& error) {
    return explain(error, kInputAtFault);
  } catch (const std::exception& error) {
    return explain(error, kMachineAtFault);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Draws picture.png and convergence.png from the files in an output folder of palpate; or "
      "curves from a table.",
      "palpate-draw");
  Wish wish;
  FigureWish figure;
  app.add_option("paths", wish.paths, "OUT_DIR; with --curves: CURVES.csv OUT.png")->required();
  app.add_flag("--curves", wish.curves,
               "Draw a table: first column x, then `name` and optionally `name_se` (standard "
               "error) for each curve");
  app.add_option("--title", wish.title, "Title of the chart");
  app.add_option("--x-label", wish.x_label,
                 "Label of the x axis (default: the first column's name)");
  app.add_option("--y-label", wish.y_label, "Label of the y axis");
  app.add_flag("--log-y", wish.logarithmic_y, "Logarithmic y axis");
  app.add_option("--spread", wish.spread, "How standard errors are shown")
      ->check(CLI::IsMember({"bars", "band", "none"}));
  app.add_option("--width", wish.width_px, "Width of the chart in pixels")
      ->check(CLI::Range(300, 8000));
  app.add_option("--height", wish.height_px, "Height of the chart in pixels")
      ->check(CLI::Range(200, 8000));
  app.add_option("--figure", figure.file, "Draw panels of the runs into this .png, .svg or .pdf");
  app.add_option("--panels", figure.panels, "Of a figure")
      ->delimiter(',')
      ->check(CLI::IsMember({"mean", "stddev", "boundary"}));
  app.add_option("--width-mm", figure.width_mm, "Of a figure")->check(CLI::Range(10.0, 2000.0));
  app.add_option("--dpi", figure.dots_per_inch, "Of a figure")->check(CLI::Range(30.0, 1200.0));
  app.add_option("--limits", figure.limits, "Of the mean's colours")->expected(2);
  app.add_option("--stddev-limits", figure.stddev_limits, "Of the standard deviation's")
      ->expected(2);
  app.add_flag("--overwrite", wish.overwrite, "Replace pictures that are none of the run's");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUsage;
  }
  return fulfil_or_explain(wish, figure);
}
