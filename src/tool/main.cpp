// palpate: where to touch next, and where the tumour under the surface ends.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>
#include <thread>

#include "experiments/experiment_command.h"
#include "link/link_command.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"
#include "scene/exit_code.h"
#include "scene/interrupt.h"
#include "tool/commands.h"
#include "tool/draw_command.h"
#include "tool/export_command.h"
#include "tool/help_command.h"
#include "tool/mesh_options.h"
#include "tool/option_checks.h"
#include "tool/readings_options.h"
#include "tool/register_command.h"
#include "tool/report_command.h"
#include "tool/session_options.h"
#include "tool/standard_streams.h"
#include "tool/surface_command.h"

namespace {

using namespace palpation;
using namespace palpation::tool;

constexpr double kMostTrials = 1e6;

struct Arguments {
  SceneArguments scene;
  InfoArguments info;
  MeshArguments mesh;
  SurfaceArguments surface;
  ExperimentArguments experiment;
  std::filesystem::path measurements, a, b;
  std::vector<std::filesystem::path> inputs;  ///< of an experiment: a scene, a study, or shards
  std::vector<std::filesystem::path> recordings;
  bool overwrite = false;  // tables of an experiment
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

/// An empty name, as of a variable in a script that is not set, would mean that nothing is asked
/// for.
void add_out(CLI::App& command, std::filesystem::path& folder, const std::string& what) {
  command.add_option("--out", folder, what)->check([](const std::string& name) {
    return name.empty() ? "is empty, but must name a folder" : "";
  });
}

CLI::App* scene_command(CLI::App& app, Arguments& arguments, const std::string& name,
                        const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what);
  command
      ->add_option("SCENE", arguments.scene.scene,
                   "the scene, a JSON file (see: palpate help scene)")
      ->required();
  add_out(*command, arguments.scene.out,
          "folder for the results; without it they are only printed");
  command->add_flag("--overwrite", arguments.scene.overwrite,
                    "replace another run's results in that folder");
  command
      ->add_option(
          "--set", arguments.scene.overrides,
          "override a value of the scene, such as plan.acquisition=evr; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command->add_option("--seed", arguments.scene.seed, "override the scene's seed")
      ->check(whole(0, kMostSeed));
  command
      ->add_option("--threads", arguments.threads,
                   "how many threads to use; the results do not depend on it")
      ->check(whole(1, 1024));
  command->add_flag("--quiet", arguments.scene.quiet, "print only warnings and errors");
  return command;
}

void add_scene_commands(CLI::App& app, Arguments& arguments) {
  scene_command(app, arguments, "simulate", "Run the whole plan on a simulated phantom")
      ->callback([&] { simulate(arguments.scene); });

  CLI::App* planning =
      scene_command(app, arguments, "plan", "Where to touch next, from what was measured so far");
  planning->add_option("--measurements", arguments.measurements,
                       "CSV with columns x,y,z,reading: metres in the frame of the mesh, whatever "
                       "robot.from_tissue says; left out: nothing was measured yet");
  planning->callback([&] { plan(arguments.scene, arguments.measurements); });

  CLI::App* bounding =
      scene_command(app, arguments, "boundary", "Where the tumour ends, from what was measured");
  bounding
      ->add_option("--measurements", arguments.measurements,
                   "CSV with columns x,y,z,reading: metres in the frame of the mesh, whatever "
                   "robot.from_tissue says")
      ->required();
  bounding->callback([&] { boundary(arguments.scene, arguments.measurements); });

  CLI::App* replaying = scene_command(
      app, arguments, "replay", "Run the whole plan, each touch answered from dense recordings");
  replaying
      ->add_option("--recording", arguments.recordings,
                   "CSV with columns x,y,z,reading [m]; one for each direction of travel")
      ->required()
      ->allow_extra_args(false);
  replaying->callback([&] { replay(arguments.scene, arguments.recordings); });

  CLI::App* comparing =
      scene_command(app, arguments, "compare", "Compare two boundaries: the area between them");
  comparing->add_option("A", arguments.a, "the estimate: a .wkt or .vtp file")->required();
  comparing->add_option("B", arguments.b, "the truth, or what is taken for it")->required();
  comparing->callback([&] { compare_boundaries(arguments.scene, arguments.a, arguments.b); });
}

void add_info_command(CLI::App& app, Arguments& arguments) {
  CLI::App* telling = app.add_subcommand(
      "info", "Check a mesh, or the tissue of a scene: what it supports, what to do next");
  telling
      ->add_option(
          "FILE", arguments.info.file,
          "a mesh (OBJ, OFF, STL, PLY or VTP); or a scene (.json): its tissue, cut out and refined")
      ->required();
  telling
      ->add_option("--unit", arguments.info.unit,
                   "of a mesh's coordinates (required for a mesh): mm, cm or m")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  telling
      ->add_option("--set", arguments.info.overrides,
                   "override a value of the scene; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  telling->callback([&] { info(arguments.info); });
}

void experiment_or_merge(Arguments& arguments) {
  ExperimentArguments& asked = arguments.experiment;
  if (asked.name.empty())
    throw WrongUsage("experiment: NAME is required: palpate experiment --list lists them");
  const Existing results = arguments.overwrite ? Existing::Replaced : Existing::Kept;
  if (asked.name == "merge") {
    if (arguments.inputs.empty())
      throw WrongUsage("experiment merge: needs the folders that hold the shards");
    return merge_experiment(arguments.inputs, asked.out, results);
  }
  if (arguments.inputs.size() > 1)
    throw WrongUsage("experiment " + asked.name + ": takes one scene, not " +
                     std::to_string(arguments.inputs.size()));
  if (!arguments.inputs.empty()) asked.scene = arguments.inputs.front();
  experiment(asked, results);
}

void add_experiment_command(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("experiment", "Measure a method over many trials");
  command->add_option("NAME", arguments.experiment.name, "which; or merge, to add up shards")
      ->check(CLI::IsMember(experiment_names()));
  command->add_option("SCENE", arguments.inputs,
                      "in place of the paper's phantom; of study its file; of merge the shards' "
                      "folders");
  command
      ->add_option("--shard", arguments.experiment.shard,
                   "run only the I-th of N parts of the trials, and keep their rows in --out")
      ->type_name("I/N");
  command
      ->add_option("--trials", arguments.experiment.trials, "per cell; default: 5, for tradeoff 20")
      ->check(whole(1, kMostTrials));
  command
      ->add_option("--first-seed", arguments.experiment.first_seed,
                   "seed of the first trial; the others follow")
      ->check(whole(0, kMostSeed - kMostTrials));
  command
      ->add_option("--set", arguments.experiment.overrides,
                   "override a value of every scene; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command
      ->add_option(
          "--only", arguments.experiment.only,
          "for table1, table2 and curved: run only the cells with this text in their names")
      ->allow_extra_args(false);
  command->add_option("--world", arguments.experiment.material.world,
                      "for experiment coverage: worlds of the catalogue, a family, a kind, or all");
  command->add_option("--recordings", arguments.experiment.material.recordings,
                      "for experiment recordings: the folder with the physical recordings");
  command->add_flag("--print-scene", arguments.experiment.print_scene,
                    "print the scene of every cell instead of running it; of one cell a scene that "
                    "simulate takes");
  const CLI::Option* list = command->add_flag("--list")->description(
      "list the experiments; with a name, the cells of that one");
  add_out(*command, arguments.experiment.out, "folder for the table and the picture");
  command->add_flag("--overwrite", arguments.overwrite,
                    "begin anew in a folder that holds another experiment");
  command
      ->add_option("--threads", arguments.threads,
                   "trials run at once; the results do not depend on it")
      ->check(whole(1, 1024));
  command->add_flag("--quiet", arguments.experiment.quiet, "no progress");
  command->callback([&arguments, list] {
    if (list->count() > 0) return list_experiments(arguments.experiment);
    experiment_or_merge(arguments);
  });
}

int explain(const char* words, int code) {
  std::fflush(stdout);
  std::fprintf(stderr, "palpate: %s\n", words);
  return code;
}

int run_tool(int count, char** words) {
  CLI::App app(
      "Decides where a robot should touch tissue next, and says where the tumour under the surface "
      "ends and how sure that is.");
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", PALPATION_VERSION);
  app.footer(
      "Start with:  palpate simulate examples/planar.json --out out/planar\nExit codes: 0 done, 2 "
      "wrong usage, 3 an input is at fault, 4 "
      "the machine or the arithmetic failed, 130 interrupted.");
  Arguments arguments;
  app.parse_complete_callback([&] { set_thread_count(arguments.threads); });
  add_scene_commands(app, arguments);
  add_info_command(app, arguments);
  add_mesh_command(app, arguments.mesh, arguments.surface);
  add_readings_command(app);
  add_register_command(app);
  add_session_command(app);
  add_serve_command(app);
  link::add_link_command(app);
  add_export_command(app);
  add_report_command(app);
  add_draw_command(app);
  add_experiment_command(app, arguments);
  add_help_command(app);
  for (CLI::App* command : app.get_subcommands({}))
    command->parse_complete_callback([&] { set_thread_count(arguments.threads); });
  try {
    app.parse(count, words);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  } catch (const std::bad_alloc& error) {
    return explain("not enough memory", exit_code_of(error));
  } catch (const std::exception& error) {
    return explain(error.what(), exit_code_of(error));
  }
}

}  // namespace

int main(int count, char** words) {
  guard_standard_streams();
  watch_for_interrupt();
  const int code = run_tool(count, words);
  if (finish_standard_output()) return code;
  return code == kDone ? explain("cannot write to standard output", kMachineAtFault) : code;
}
