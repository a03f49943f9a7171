#include "scene/output_folder.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <optional>
#include <utility>

#include "io/files_read.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/wkt.h"
#include "palpation/io/write_vtp.h"
#include "results/report.h"
#include "results/sha256.h"
#include "scene/believed.h"
#include "scene/draw_program.h"
#include "scene/interrupt.h"
#include "scene/progress.h"
#include "scene/result_tables.h"
#include "scene/run_files.h"
#include "scene/summary.h"

namespace palpation::tool {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Names of files may be any bytes; what is no text in them must not keep the summary from being
/// written.
std::string document(const json& object) {
  return object.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

/// The command, the scene's values, and which files were read beside it: their content may have
/// grown since.
RunRequest request_of(const Destination& destination, const Scene& scene, json begun) {
  std::string question = destination.command + "\n" + document(scene.complete());
  for (const fs::path& path : files_read())
    if (path.string() != scene.name()) question += fs::weakly_canonical(path).string() + "\n";
  return {.command = destination.command,
          .question = std::move(question),
          .begun = std::move(begun),
          .overwrite = destination.overwrite,
          .measures = destination.command == "simulate" || destination.command == "replay"};
}

/// What was read so far, each with its digest: what a person must have to get the same again.
json inputs_read() {
  json inputs = json::array();
  for (const fs::path& path : files_read())
    inputs.push_back(
        {{"file", path.string()}, {"sha256", results::sha256_digits(read_file(path))}});
  return inputs;
}

/// Of a run that does not end there is no summary.
json begun_of(const Scene& scene, const json& inputs, const std::vector<std::string>& warnings) {
  return {{"scene", scene.name()},
          {"seed", scene.seed()},
          {"options", scene.complete()},
          {"inputs", inputs},
          {"warnings", warnings}};
}

NamedFields fields_of(const Episode& episode, const World* world) {
  NamedFields fields = believed_fields(episode, world);
  // Curved tissue may hide a part of itself: a picture can show it laid flat.
  if (const Surface& surface = episode.exploration.surface(); !surface.is_planar()) {
    fields.emplace_back("chart_u", surface.chart().uv.col(0));
    fields.emplace_back("chart_v", surface.chart().uv.col(1));
  }
  return fields;
}

}  // namespace

OutputFolder::OutputFolder(const Destination& destination, const Scene& scene, const Tissue& tissue,
                           std::vector<std::string> warnings)
    : inputs_(inputs_read()),
      warnings_(std::move(warnings)),
      run_(destination.folder, request_of(destination, scene, begun_of(scene, inputs_, warnings_))),
      scene_(scene),
      surface_(tissue.surface),
      frame_(tissue.frame),
      command_(destination.command) {}

void OutputFolder::write_step(const Episode& episode, const World* world) {
  std::string number = std::to_string(episode.exploration.batch() - 1);
  number.insert(0, number.size() < 3 ? 3 - number.size() : 0, '0');
  const std::string name = "step_" + number + ".vtp";
  run_.add_step(name, [&](const fs::path& path) {
    write_surface_vtp(path, surface_, fields_of(episode, world), frame_);
  });
  steps_.push_back("steps/" + name);
  run_.add_growing(kStepsListName, [&](const fs::path& path) { write_pvd(path, steps_); });
  run_.add_growing(kMeasurementsName, [&](const fs::path& path) {
    write_atomically(path, measurements_csv(surface_, episode.exploration.readings()));
  });
}

void OutputFolder::write_boundary(const Episode& episode, const World* world) {
  run_.add("boundary.wkt", to_wkt(episode.estimate) + "\n");
  const std::vector<BoundaryCurve> curves = believed_curves(scene_, episode, world);
  run_.add("boundary.vtp",
           [&](const fs::path& path) { write_boundary_vtp(path, surface_, curves, frame_); });
}

void OutputFolder::write(const Episode& episode, const World* world, const json& timings,
                         const ForeignColumns& foreign) {
  check_interrupt();
  run_.add("surface.vtp", [&](const fs::path& path) {
    write_surface_vtp(path, surface_, fields_of(episode, world), frame_);
  });
  write_boundary(episode, world);
  run_.add(world != nullptr ? kMeasurementsName : kReadingsUsedName,
           measurements_csv(surface_, episode.exploration.readings(), foreign));
  if (!episode.trace.empty()) run_.add("trace.csv", trace_csv(episode.trace, surface_.area()));
  if (!steps_.empty())
    run_.add(kStepsListName, [&](const fs::path& path) { write_pvd(path, steps_); });
  run_.add(kTimingsName, document(timings));
  json summary = summary_of(episode, scene_, warnings_);
  summary["inputs"] = inputs_;
  run_.add(kSummaryName, document(summary));
}

void OutputFolder::write_waypoints(const std::vector<Waypoint>& stops,
                                   const std::vector<Waypoint>& way, const std::vector<int>& legs) {
  run_.add("waypoints.csv", waypoint_csv(stops));
  run_.add("path.csv", waypoint_csv(way, &legs));
}

void OutputFolder::write_comparison(const RegionError& error) {
  run_.add(kSummaryName, document(comparison_of(error, scene_, surface_, warnings_)));
  run_.land();
}

/// From the files that are about to land: what it tells is what they tell.
void OutputFolder::write_report(const fs::path& folder) const {
  results::Run run = results::read_run(folder);
  run.steps.clear();
  for (const std::string& step : steps_) run.steps.push_back(run_.place_of(step));
  write_atomically(folder / kReportName,
                   results::report_html(run, {PALPATION_VERSION, command_, "complete"}));
}

void OutputFolder::finish(bool quiet) {
  std::optional<std::string> no_picture, no_report;
  run_.add_made({"picture.png", "convergence.png"}, [&](const fs::path& folder) {
    const Stage drawing("Drawing the pictures", quiet);
    no_picture = run_draw({folder.string()});
  });
  const bool is_reported = command_ != "plan";  // which a robot waits for
  if (is_reported) {
    run_.add_made({kReportName}, [&](const fs::path& folder) {
      const Stage reporting("Making the report", quiet);
      try {
        write_report(folder);
      } catch (const Error& error) {
        no_report = error.what();
      } catch (const std::bad_alloc&) {
        no_report = "not enough memory";
      }
    });
  }
  run_.land();
  if (no_picture) std::fprintf(stderr, "palpate: no picture: %s\n", no_picture->c_str());
  if (no_report) std::fprintf(stderr, "palpate: no report: %s\n", no_report->c_str());
  check_interrupt();
  if (quiet) return;
  std::string words = no_picture ? "" : "picture.png";
  if (is_reported && !no_report) words += (words.empty() ? "" : " and ") + std::string(kReportName);
  std::printf("Written to %s%s\n", run_.path().string().c_str(),
              words.empty() ? "" : (", with " + words).c_str());
}

}  // namespace palpation::tool
