#include "results/export.h"

#include <array>
#include <limits>

#include "palpation/base/error.h"
#include "results/clip.h"
#include "results/markups.h"
#include "results/parts.h"
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

/// Told apart also by people who confuse red and green: bluish green, amber, grey, magenta.
const std::vector<double> kTouched = {0.0, 0.62, 0.45};
const std::vector<double> kSetAside = {0.96, 0.67, 0.08};
const std::vector<double> kMissed = {0.5, 0.5, 0.5};
const std::vector<double> kNext = {0.89, 0.0, 0.55};

void add_model(Files& files, const std::string& name, const VtpShape& model, LengthUnit unit,
               Frame frame) {
  if (!model.points.empty()) files[name] = vtp_of(name, model, unit, frame);
}

/// Surfaces and lines, alike for all who show them.
Files models_of(const Run& run, LengthUnit unit, Frame frame) {
  Files files;
  add_model(files, "tissue.vtp", model_of(run.tissue, shown_fields()), unit, frame);
  add_model(files, "tumour.vtp", tumour_of(run), unit, frame);
  add_model(files, "band.vtp", band_of(run), unit, frame);
  add_model(files, "not_searched.vtp", not_searched_of(run), unit, frame);
  add_model(files, "outline.vtp", lines_of(run.curves, {"estimate"}), unit, frame);
  add_model(files, "band_lines.vtp", lines_of(run.curves, {"band_inner", "band_outer"}), unit,
            frame);
  add_model(files, "cut_line.vtp", lines_of(run.curves, {"cut"}), unit, frame);
  add_model(files, "true_outline.vtp", lines_of(run.curves, {"truth"}), unit, frame);
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

std::string words_on(const Touch& touch, const std::string& unit) {
  std::string words = "batch " + std::to_string(touch.batch);
  if (touch.reading)
    words = "reading " + text_of(*touch.reading) + (unit.empty() ? "" : " " + unit) + ", " + words;
  if (touch.is_missed()) words += ", could not be touched";
  if (!touch.set_aside.empty()) words += ", set aside: " + touch.set_aside;
  return words;
}

template <typename Belongs>
void add_markups(Files& files, const Run& run, const std::string& name, Frame frame,
                 const std::vector<double>& colour, Belongs belongs) {
  std::vector<Mark> marks;
  for (const Touch& touch : run.touches)
    if (belongs(touch))
      marks.push_back(
          {std::to_string(touch.number), words_on(touch, run.reading_unit()), touch.place});
  if (!marks.empty()) files[name + ".mrk.json"] = markups_json(name, marks, frame, colour);
}

/// Readings on the way, by the thousand, are a model: Slicer's markups are for places by the
/// hundred.
Files for_slicer(const Run& run, Frame frame) {
  Files files = models_of(run, LengthUnit::Millimetre, frame);
  add_markups(files, run, "touches", frame, kTouched,
              [](const Touch& touch) { return touch.counts() && touch.kind != "way"; });
  add_markups(files, run, "set_aside", frame, kSetAside,
              [](const Touch& touch) { return !touch.set_aside.empty() && !touch.is_missed(); });
  add_markups(files, run, "missed", frame, kMissed,
              [](const Touch& touch) { return touch.is_missed(); });
  std::vector<Touch> way;
  for (const Touch& touch : run.touches)
    if (touch.kind == "way" && touch.counts()) way.push_back(touch);
  add_model(files, "way.vtp", dots_of(way), LengthUnit::Millimetre, frame);
  std::vector<Mark> next;
  for (const Vec3& place : run.next_stops)
    next.push_back({std::to_string(next.size() + 1), "to be touched next", place});
  if (!next.empty()) files["next_stops.mrk.json"] = markups_json("next_stops", next, frame, kNext);
  return files;
}

Files for_paraview(const Run& run, Frame frame) {
  Files files = models_of(run, LengthUnit::Metre, frame);
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
