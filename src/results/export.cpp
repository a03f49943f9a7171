#include "results/export.h"

#include <array>
#include <limits>

#include "palpation/base/error.h"
#include "results/markups.h"
#include "results/shown.h"
#include "results/slicer_scene.h"
#include "results/tables.h"

namespace palpation::results {
namespace {

using Files = std::map<std::string, std::string>;

struct NamedProgram {
  const char* name;
  Program program;
};
constexpr std::array<NamedProgram, 3> kPrograms = {
    {{"slicer", Program::Slicer}, {"paraview", Program::ParaView}, {"csv", Program::Csv}}};

void add_model(Files& files, const std::string& name, const VtpShape& model, LengthUnit unit,
               Frame frame) {
  if (!model.points.empty()) files[name] = vtp_of(name, model, unit, frame);
}

/// Surfaces and lines, alike for all who show them.
Files files_of_models(const Run& run, LengthUnit unit, Frame frame) {
  Files files;
  for (const NamedModel& model : models_of(run))
    add_model(files, model.name + ".vtp", model.shape, unit, frame);
  return files;
}

/// Touches as points with all that is known of them.
VtpShape dots_of(const std::vector<Touch>& touches) {
  VtpShape model;
  std::vector<double> number, reading, batch, counts;
  std::vector<std::string> kind, set_aside;
  for (const Touch& touch : touches) {
    model.dots.push_back(static_cast<int>(model.points.size()));
    model.points.push_back(touch.place);
    number.push_back(touch.number);
    reading.push_back(touch.reading.value_or(std::numeric_limits<double>::quiet_NaN()));
    batch.push_back(touch.batch);
    counts.push_back(touch.counts() ? 1.0 : 0.0);
    kind.push_back(touch.kind);
    set_aside.push_back(touch.set_aside);
  }
  model.point_fields = {
      {"reading", reading}, {"number", number}, {"batch", batch}, {"counts", counts}};
  model.point_texts = {{"kind", kind}, {"set_aside", set_aside}};
  return model;
}

VtpShape dots_of(const std::vector<Vec3>& places) {
  VtpShape model;
  std::vector<double> number;
  for (const Vec3& place : places) {
    model.dots.push_back(static_cast<int>(model.points.size()));
    model.points.push_back(place);
    number.push_back(static_cast<double>(model.points.size()));
  }
  model.point_fields = {{"number", number}};
  return model;
}

/// Readings on the way, by the thousand, are a model: Slicer's markups are for places by the
/// hundred.
Files for_slicer(const Run& run, Frame frame) {
  Files files = files_of_models(run, LengthUnit::Millimetre, frame);
  const std::vector<NamedMarks> lists = marks_of(run);
  for (const NamedMarks& list : lists)
    if (!list.marks.empty())
      files[list.name + ".mrk.json"] = markups_json(list.name, list.marks, frame, list.colour);
  std::vector<Touch> way;
  for (const Touch& touch : run.touches)
    if (touch.kind == "way" && touch.counts()) way.push_back(touch);
  add_model(files, "way.vtp", dots_of(way), LengthUnit::Millimetre, frame);
  std::vector<std::string> models;
  for (const auto& [name, unused] : files)
    if (name.ends_with(".vtp")) models.push_back(name.substr(0, name.size() - 4));
  files[kSlicerScene] = slicer_scene(run, models, lists, frame);
  return files;
}

Files for_paraview(const Run& run, Frame frame) {
  Files files = files_of_models(run, LengthUnit::Metre, frame);
  add_model(files, "touches.vtp", dots_of(run.touches), LengthUnit::Metre, frame);
  add_model(files, "next_stops.vtp", dots_of(run.next_stops), LengthUnit::Metre, frame);
  std::string list =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n  <Collection>\n";
  int part = 0;
  for (const auto& [name, unused] : files)
    list += "    <DataSet timestep=\"0\" part=\"" + std::to_string(part++) + "\" name=\"" +
            name.substr(0, name.find('.')) + "\" file=\"" + name + "\"/>\n";
  files["palpation.pvd"] = list + "  </Collection>\n</VTKFile>\n";
  return files;
}

}  // namespace

Program program_of(const std::string& name) {
  for (const NamedProgram& one : kPrograms)
    if (name == one.name) return one.program;
  throw InvalidInput("program_of: \"" + name + "\" must be slicer, paraview or csv");
}

std::string name_of(Program program) {
  for (const NamedProgram& one : kPrograms)
    if (program == one.program) return one.name;
  throw InvalidInput("name_of: program " + std::to_string(static_cast<int>(program)) +
                     " does not exist");
}

Files exported(const Run& run, Program program, Frame frame) {
  switch (program) {
    case Program::Slicer:
      require(frame != Frame::Mesh, "exported", "the mesh's own frame",
              "must be RAS or LPS for 3D Slicer");
      return for_slicer(run, frame);
    case Program::ParaView:
      return for_paraview(run, frame);
    case Program::Csv:
      return tables_of(run);
  }
  throw InvalidInput("exported: program " + std::to_string(static_cast<int>(program)) +
                     " does not exist");
}

}  // namespace palpation::results
