#include "tool/report_command.h"

#include <cstdio>
#include <memory>

#include "results/report.h"
#include "scene/add_to_run.h"
#include "scene/draw_program.h"
#include "scene/run_files.h"
#include "scene/run_record.h"
#include "scene/single_file.h"

namespace palpation::tool {

namespace fs = std::filesystem;

void report_run(const ReportArguments& arguments) {
  const RunRecord record = read_run_record(arguments.run)
                               .value_or(RunRecord{.command = "", .question = "", .state = ""});
  const results::Run run = results::read_run(arguments.run);
  // It did not come so far.
  const bool drew_none = run.summary.is_null() && !fs::exists(arguments.run / "picture.png");
  if (const auto reason = drew_none ? run_draw({arguments.run.string()}) : std::nullopt)
    std::fprintf(stderr, "palpate: no picture: %s\n", reason->c_str());
  const std::string page =
      results::report_html(run, {PALPATION_VERSION, record.command, record.state});
  const Existing existing = arguments.overwrite ? Existing::Replaced : Existing::Kept;
  const fs::path path = arguments.out.empty() ? arguments.run / kReportName : arguments.out;
  if (arguments.out.empty()) {
    add_to_run(arguments.run, {{kReportName, page}}, existing);
  } else {
    write_single_file(path, page, existing);
  }
  std::printf("Written to %s, %.1f MB: open it in any browser; it needs nothing beside it\n",
              path.string().c_str(), 1e-6 * static_cast<double>(page.size()));
}

void add_report_command(CLI::App& app) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "One page of a run, for a browser: verdict, tissue in 3-D, readings, origin");
  command->add_option("DIR", arguments->run, "the folder that --out named")->required();
  command->add_option("--out", arguments->out, "the page to write; left out: report.html in DIR")
      ->check([](const std::string& name) {
        return name.empty() ? "is empty, but must name a file" : "";
      });
  command->add_flag("--overwrite", arguments->overwrite,
                    "replace a page of that name that is none of the run's");
  command->callback([arguments] { report_run(*arguments); });
}

}  // namespace palpation::tool
