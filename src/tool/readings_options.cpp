#include "tool/readings_options.h"

#include <memory>

#include "tool/option_checks.h"
#include "tool/readings_command.h"

namespace palpation::tool {
namespace {

void add_columns(CLI::App& command, LogNames& names) {
  command
      .add_option(
          "--column", names.columns,
          "which column plays a role, where its name does not say so: time, x, y, z, depth, "
          "force, fx, fy, fz, count, nx, ny, nz, contact_x, contact_y, contact_z, probe, "
          "sample, session; once for each")
      ->allow_extra_args(false)
      ->type_name("ROLE=NAME");
  command
      .add_option(
          "--unit", names.units,
          "of time, position, depth or force, where names of columns do not end in it, such "
          "as position=mm, force=counts; once for each")
      ->allow_extra_args(false)
      ->type_name("QUANTITY=UNIT");
  command.add_option("--gain", names.gain, "newtons a count; left out: readings are in counts")
      ->check(number(-1e12, 1e12));
  command.add_option("--offset", names.offset, "counts at no force")->check(number(-1e12, 1e12));
  command.add_option("--session", names.session, "a name for all readings of this log");
}

void add_models(CLI::App& command, ProbingChoice& probing) {
  command
      .add_option(
          "--model", probing.model,
          "of probings: linear (stiffness, per mm), hertz (modulus under a sphere), or force "
          "(at a depth)")
      ->check(CLI::IsMember({"linear", "hertz", "force"}));
  command.add_option("--radius-mm", probing.radius_mm, "of hertz: the indenter's")
      ->check(number(1e-3, 1e3));
  command.add_option("--at-mm", probing.at_mm, "of force: the depth")->check(number(1e-3, 1e3));
  command
      .add_option("--approach", probing.approach,
                  "of probings: whether they begin in the air; auto: looked for")
      ->check(CLI::IsMember({"auto", "yes", "no"}));
  command.add_option("--least-samples", probing.least_samples, "of probings: fewer give none")
      ->check(whole(3, 1e6));
}

void add_windows(CLI::App& command, SlideChoice& slide) {
  command
      .add_option("--frequency-hz", slide.frequency_hz, "of a slide's oscillation; left out: found")
      ->check(number(1e-3, 1e4));
  command
      .add_option("--window-periods", slide.window_periods,
                  "of a slide: periods that make a reading (4)")
      ->check(whole(4, 1e4));
}

}  // namespace

void add_readings_command(CLI::App& app) {
  const auto arguments = std::make_shared<ReadingsArguments>();  // lives as long as the command
  CLI::App* command =
      app.add_subcommand("readings", "From a robot's log to readings with their noise");
  command
      ->add_option("LOG", arguments->files.log,
                   "CSV: positions with forces, depths or counts, units in the names of columns: "
                   "x_mm, depth [mm], force(N), t_s")
      ->required();
  command->add_option("--out", arguments->files.out, "the readings, a CSV for --measurements")
      ->required();
  command->add_option("--left-out", arguments->files.left_out,
                      "CSV of what gave no reading, each with its reason");
  command
      ->add_option(
          "--kind", arguments->kind,
          "of log: probings (in and out), slide (with an oscillation), scan (each sample a "
          "reading); auto: by what it holds")
      ->check(CLI::IsMember({"auto", "probings", "slide", "scan"}));
  add_columns(*command, arguments->names);
  add_models(*command, arguments->probing);
  add_windows(*command, arguments->slide);
  command
      ->add_option("--every-mm", arguments->every_mm, "of a scan: travel that makes a reading (1)")
      ->check(number(1e-3, 1e3));
  command->add_flag("--overwrite", arguments->files.overwrite,
                    "replace other files of these names");
  command->add_flag("--quiet", arguments->quiet, "no words but errors");
  command->callback([arguments] { readings(*arguments); });
}

}  // namespace palpation::tool
