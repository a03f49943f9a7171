#include "tool/export_command.h"

#include <cstdio>
#include <memory>

#include "palpation/base/error.h"
#include "results/export.h"
#include "results/slicer_scene.h"
#include "scene/patient_frame.h"
#include "tool/export_folder.h"

namespace palpation::tool {
namespace {

using results::Program;
namespace fs = std::filesystem;

Frame frame_for(const ExportArguments& arguments, const results::Run& run) {
  const Frame frame = frame_asked(arguments.frame, run.frame(), arguments.run.string());
  if (results::program_of(arguments.program) == Program::Slicer)
    require_patients_frame(frame, "export");
  return frame;
}

std::string where_words(Program program, const fs::path& folder) {
  switch (program) {
    case Program::Slicer:
      return "In 3D Slicer: drag " + (folder / results::kSlicerScene).string() +
             " into its window for all of it, in colour; or single files, as models and markups.";
    case Program::ParaView:
      return "In ParaView: open " + (folder / "palpation.pvd").string() +
             "; the batches of a run are steps.pvd beside its surface.vtp.";
    case Program::Csv:
      return "Each table names the units of its columns in its first line.";
  }
  return "";
}

}  // namespace

void export_run(const ExportArguments& arguments) {
  const results::Run run = results::read_run(arguments.run);
  const Program program = results::program_of(arguments.program);
  const Frame frame = frame_for(arguments, run);
  const fs::path folder = arguments.out.empty() ? arguments.run / arguments.program : arguments.out;
  const std::map<std::string, std::string> files = results::exported(run, program, frame);
  write_export(folder, arguments.program, files,
               arguments.overwrite ? Existing::Replaced : Existing::Kept);
  if (run.summary.is_null())
    std::fprintf(stderr,
                 "palpate: warning: %s holds a run that did not end: exported as it was after its "
                 "last batch, without a boundary\n",
                 arguments.run.string().c_str());
  std::string names;
  for (const auto& [name, unused] : files) names += (names.empty() ? "" : ", ") + name;
  const std::string unit = program == Program::ParaView ? "metres" : "millimetres";
  std::printf("Written to %s, in %s%s: %s\n%s\n", folder.string().c_str(), unit.c_str(),
              program == Program::Csv ? ""
              : frame == Frame::Mesh  ? ", in the mesh's own frame"
                                      : (", " + name_of(frame)).c_str(),
              names.c_str(), where_words(program, folder).c_str());
}

void add_export_command(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "A run's results as other programs expect them");
  command->add_option("DIR", arguments->run, "the folder that --out named")->required();
  command
      ->add_option("--for", arguments->program,
                   "slicer: models in millimetres that say RAS or LPS, touches as markups; "
                   "paraview: models in metres; csv: tables with units in their names")
      ->required()
      ->check(CLI::IsMember({"slicer", "paraview", "csv"}));
  command
      ->add_option(
          "--frame", arguments->frame,
          "whose frame the coordinates are in, where neither the scene (surface.frame) nor "
          "the mesh's file says; it names the frame and moves nothing")
      ->check(CLI::IsMember({"RAS", "LPS"}));
  command
      ->add_option("--out", arguments->out,
                   "folder for the files; left out: slicer, paraview or csv within DIR")
      ->check([](const std::string& name) {
        return name.empty() ? "is empty, but must name a folder" : "";
      });
  command->add_flag("--overwrite", arguments->overwrite,
                    "replace files of these names that no export wrote");
  command->callback([arguments] { export_run(*arguments); });
}

}  // namespace palpation::tool
