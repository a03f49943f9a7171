// palpate: where to touch next, and where the tumour under the surface ends.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
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
#include "tool/misspelt.h"
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

/// Of every command that takes long.
void add_threads(CLI::App& command, const std::string& what) {
  const auto count =
      std::make_shared<int>(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  command.add_option("--threads", *count, what)->check(whole(1, 1024));
  command.parse_complete_callback([count] { set_thread_count(*count); });
}

/// An empty name, as of a variable in a script that is not set, would mean that nothing is asked
/// for.
void add_out(CLI::App& command, std::filesystem::path& folder, const std::string& what) {
  command.add_option("--out", folder, what)->check([](const std::string& name) {
    return name.empty() ? "is empty, but must name a folder" : "";
  });
}

/// A command on a scene, and what it will be given.
struct SceneCommand {
  CLI::App& command;
  std::shared_ptr<SceneArguments> scene = std::make_shared<SceneArguments>();
};

SceneCommand scene_command(CLI::App& app, const std::string& name, const std::string& what) {
  SceneCommand made{*app.add_subcommand(name, what)};
  SceneArguments& arguments = *made.scene;
  made.command
      .add_option("SCENE", arguments.scene, "the scene, a JSON file (see: palpate help scene)")
      ->required();
  add_out(made.command, arguments.out, "folder for the results; without it they are only printed");
  made.command.add_flag("--overwrite", arguments.overwrite,
                        "replace another run's results in that folder");
  made.command
      .add_option(
          "--set", arguments.overrides,
          "override a value of the scene, such as plan.acquisition=evr; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  made.command.add_option("--seed", arguments.seed, "override the scene's seed")
      ->check(whole(0, kMostSeed));
  add_threads(made.command, "how many threads to use; the results do not depend on it");
  made.command.add_flag("--quiet", arguments.quiet, "print only warnings and errors");
  return made;
}

/// A file that is given, or several.
template <typename Given>
std::shared_ptr<Given> add_given(CLI::App& command, const std::string& name,
                                 const std::string& what, bool is_required = true) {
  const auto given = std::make_shared<Given>();
  command.add_option(name, *given, what)->required(is_required)->allow_extra_args(false);
  return given;
}

void add_scene_commands(CLI::App& app) {
  using std::filesystem::path;
  const SceneCommand simulating =
      scene_command(app, "simulate", "Run the whole plan on a simulated phantom");
  simulating.command.callback([scene = simulating.scene] { simulate(*scene); });

  const SceneCommand planning =
      scene_command(app, "plan", "Where to touch next, from what was measured so far");
  const auto so_far =
      add_given<path>(planning.command, "--measurements",
                      "CSV with columns x,y,z,reading: metres in the frame of the mesh, whatever "
                      "robot.from_tissue says; left out: nothing was measured yet",
                      false);
  planning.command.callback([scene = planning.scene, so_far] { plan(*scene, *so_far); });

  const SceneCommand bounding =
      scene_command(app, "boundary", "Where the tumour ends, from what was measured");
  const auto measured =
      add_given<path>(bounding.command, "--measurements",
                      "CSV with columns x,y,z,reading: metres in the frame of the mesh, whatever "
                      "robot.from_tissue says");
  bounding.command.callback([scene = bounding.scene, measured] { boundary(*scene, *measured); });

  const SceneCommand replaying =
      scene_command(app, "replay", "Run the whole plan, each touch answered from dense recordings");
  const auto recordings = add_given<std::vector<path>>(
      replaying.command, "--recording",
      "CSV with columns x,y,z,reading [m]; one for each direction of travel");
  replaying.command.callback(
      [scene = replaying.scene, recordings] { replay(*scene, *recordings); });

  const SceneCommand comparing =
      scene_command(app, "compare", "Compare two boundaries: the area between them");
  const auto a = add_given<path>(comparing.command, "A", "the estimate: a .wkt or .vtp file");
  const auto b = add_given<path>(comparing.command, "B", "the truth, or what is taken for it");
  comparing.command.callback(
      [scene = comparing.scene, a, b] { compare_boundaries(*scene, *a, *b); });
}

void add_info_command(CLI::App& app) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* telling = app.add_subcommand(
      "info", "Check a mesh, or the tissue of a scene: what it supports, what to do next");
  telling
      ->add_option(
          "FILE", arguments->file,
          "a mesh (OBJ, OFF, STL, PLY or VTP); or a scene (.json): its tissue, cut out and refined")
      ->required();
  telling
      ->add_option("--unit", arguments->unit,
                   "of a mesh's coordinates (required for a mesh): mm, cm or m")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  telling
      ->add_option("--set", arguments->overrides,
                   "override a value of the scene; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  telling->callback([arguments] { info(*arguments); });
}

/// What stands behind an experiment's name: a scene, a study, or the folders of shards.
using Inputs = std::vector<std::filesystem::path>;

ExperimentArguments with_scene(ExperimentArguments asked, const Inputs& inputs) {
  if (inputs.size() > 1)
    throw WrongUsage("experiment " + asked.name + ": takes one scene, not " +
                     std::to_string(inputs.size()));
  if (!inputs.empty()) asked.scene = inputs.front();
  return asked;
}

void experiment_or_merge(ExperimentArguments asked, const Inputs& inputs, Existing results) {
  if (asked.name.empty())
    throw WrongUsage("experiment: NAME is required: palpate experiment --list lists them");
  if (asked.name == "merge") {
    if (inputs.empty())
      throw WrongUsage("experiment merge: needs the folders that hold the shards");
    return merge_experiment(inputs, asked.out, results);
  }
  experiment(with_scene(std::move(asked), inputs), results);
}

void add_experiment_command(CLI::App& app) {
  const auto arguments = std::make_shared<ExperimentArguments>();
  const auto inputs = std::make_shared<Inputs>();
  const auto overwrite = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("experiment", "Measure a method over many trials");
  command->add_option("NAME", arguments->name, "which; or merge, to add up shards")
      ->check(CLI::IsMember(experiment_names()));
  command->add_option("SCENE", *inputs,
                      "in place of the paper's phantom; of study its file; of merge the shards' "
                      "folders");
  command
      ->add_option("--shard", arguments->shard,
                   "run only the I-th of N parts of the trials, and keep their rows in --out")
      ->type_name("I/N");
  command->add_option("--trials", arguments->trials, "per cell; default: 5, for tradeoff 20")
      ->check(whole(1, kMostTrials));
  command
      ->add_option("--first-seed", arguments->first_seed,
                   "seed of the first trial; the others follow")
      ->check(whole(0, kMostSeed - kMostTrials));
  command
      ->add_option("--set", arguments->overrides,
                   "override a value of every scene; once for each value")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command
      ->add_option(
          "--only", arguments->only,
          "for table1, table2, curved and study: run only the cells with this text in their names")
      ->allow_extra_args(false);
  command->add_option("--world", arguments->material.world,
                      "for experiment coverage: worlds of the catalogue, a family, a kind, or all");
  command->add_option("--recordings", arguments->material.recordings,
                      "for experiment recordings: the folder with the physical recordings");
  command->add_flag("--print-scene", arguments->print_scene,
                    "print the scene of every cell instead of running it; of one cell a scene that "
                    "simulate takes");
  const CLI::Option* list = command->add_flag("--list")->description(
      "list the experiments; with a name, the cells of that one");
  add_out(*command, arguments->out, "folder for the table and the picture");
  command->add_flag("--overwrite", *overwrite,
                    "begin anew in a folder that holds another experiment");
  add_threads(*command, "trials run at once; the results do not depend on it");
  command->add_flag("--quiet", arguments->quiet, "no progress");
  command->callback([arguments, inputs, overwrite, list] {
    if (list->count() > 0) return list_experiments(with_scene(*arguments, *inputs));
    experiment_or_merge(*arguments, *inputs, *overwrite ? Existing::Replaced : Existing::Kept);
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
  add_scene_commands(app);
  add_info_command(app);
  add_mesh_command(app);
  add_readings_command(app);
  add_register_command(app);
  add_session_command(app);
  add_serve_command(app);
  link::add_link_command(app);
  add_export_command(app);
  add_report_command(app);
  add_draw_command(app);
  add_experiment_command(app);
  add_help_command(app);
  try {
    app.parse(count, words);
    return kDone;
  } catch (const CLI::ParseError& error) {
    const bool was_asked = error.get_exit_code() == 0;
    const std::string misspelt = was_asked ? "" : misspelt_words(app);
    if (misspelt.empty())
      app.exit(error);
    else
      std::fputs((misspelt + "Run with --help for more information.\n").c_str(), stderr);
    return was_asked ? kDone : kWrongUsage;
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
