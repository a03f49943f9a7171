#include "tool/draw_command.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "palpation/base/error.h"
#include "results/run.h"
#include "scene/draw_program.h"
#include "scene/exit_code.h"
#include "scene/single_file.h"
#include "tool/option_checks.h"

namespace palpation::tool {
namespace {

namespace fs = std::filesystem;

struct Request {
  std::vector<fs::path> runs;
  fs::path out;
  bool overwrite = false;
  FigureArguments figure;
};

/// The file of the figure, whose name ends with its format.
fs::path file_of(const std::vector<fs::path>& runs, const fs::path& out,
                 const std::string& format) {
  const std::string ending = out.extension().string();
  if (out.empty()) {
    if (runs.size() > 1)
      throw WrongUsage("draw: several runs make one figure: name its file by --out");
    return runs.front() / ("figure." + (format.empty() ? std::string("png") : format));
  }
  if (ending != ".png" && ending != ".svg" && ending != ".pdf")
    throw WrongUsage("draw: --out " + out.string() + ": must end with .png, .svg or .pdf");
  if (!format.empty() && ending != "." + format)
    throw WrongUsage("draw: --out " + out.string() + " and --format " + format +
                     " contradict each other");
  return out;
}

void check_limits(const char* option, const std::vector<double>& limits) {
  if (!limits.empty() && !(limits[0] < limits[1] && std::isfinite(limits[1] - limits[0])))
    throw WrongUsage(std::string("draw: ") + option + ": the first must be below the second");
}

void add_pair(std::vector<std::string>& words, const char* option,
              const std::vector<double>& pair) {
  if (pair.empty()) return;
  words.insert(words.end(), {option, text_of(pair[0]), text_of(pair[1])});
}

}  // namespace

void draw_runs(const std::vector<fs::path>& runs, const fs::path& out, bool overwrite,
               const FigureArguments& figure) {
  const fs::path file = file_of(runs, out, figure.format);
  check_limits("--limits", figure.limits);
  check_limits("--stddev-limits", figure.stddev_limits);
  std::vector<std::string> words;
  for (const fs::path& run : runs) {
    results::read_run(run);  // what is wrong with it is said before anything is drawn
    words.push_back(run.string());
  }
  refuse_to_replace(file, overwrite ? Existing::Replaced : Existing::Kept);
  words.insert(words.end(), {"--figure", file.string(), "--width-mm", text_of(figure.width_mm),
                             "--dpi", text_of(figure.dots_per_inch)});
  for (const std::string& panel : figure.panels) words.insert(words.end(), {"--panels", panel});
  add_pair(words, "--limits", figure.limits);
  add_pair(words, "--stddev-limits", figure.stddev_limits);
  if (const std::optional<std::string> reason = run_draw(words))
    throw WriteError(file.string() + ": not drawn: " + *reason);
  std::printf("Written to %s\n", file.string().c_str());
}

void add_draw_command(CLI::App& app) {
  auto request = std::make_shared<Request>();
  FigureArguments& figure = request->figure;
  CLI::App* command = app.add_subcommand("draw",
                                         "Figures for papers: of a run, or of several side "
                                         "by side with common colours");
  command->add_option("DIR", request->runs, "folders that --out named; several are columns")
      ->required();
  command->add_option("--out", request->out,
                      "the figure's file, .png, .svg or .pdf; of one run left out: figure.FORMAT "
                      "in its folder");
  command
      ->add_option("--format", figure.format,
                   "png, or for print svg or pdf, whose words and "
                   "lines stay sharp")
      ->check(CLI::IsMember({"png", "svg", "pdf"}));
  command
      ->add_option("--panels", figure.panels,
                   "which, in that order: mean, stddev, boundary; left out: all three")
      ->delimiter(',')
      ->check(CLI::IsMember({"mean", "stddev", "boundary"}));
  command->add_option("--width-mm", figure.width_mm, "how wide the figure is on paper")
      ->check(number(10.0, 2000.0));
  command->add_option("--dpi", figure.dots_per_inch, "dots per inch, of the maps in svg and pdf")
      ->check(number(30.0, 1200.0));
  command
      ->add_option(
          "--limits", figure.limits,
          "between which values the colours of the mean run; left out: as the runs have it")
      ->expected(2);
  command->add_option("--stddev-limits", figure.stddev_limits, "the same of the standard deviation")
      ->expected(2);
  command->add_flag("--overwrite", request->overwrite, "replace the file");
  command->callback(
      [request] { draw_runs(request->runs, request->out, request->overwrite, request->figure); });
}

}  // namespace palpation::tool
