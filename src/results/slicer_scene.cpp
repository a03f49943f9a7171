#include "results/slicer_scene.h"

#include <algorithm>

#include "palpation/base/error.h"
#include "results/view_data.h"

namespace palpation::results {
namespace {

constexpr const char* kDiverging = "vtkMRMLColorTableNodeFileDivergingBlueRed.txt";

/// How a model looks: its colour, and whether it is a net, lines or hidden at first.
struct Look {
  const char* name;
  std::array<double, 3> colour;
  const char* more;
};

// Told apart also by people who confuse red and green: those of the report.
constexpr std::array<Look, 9> kLooks = {
    {{"tissue", {0.93, 0.93, 0.93}, ""},
     {"tumour", {0.77, 0.30, 0.27}, " visibility=\"false\""},
     {"band", {0.99, 0.78, 0.30}, " visibility=\"false\""},
     {"not_searched", {0.45, 0.45, 0.45}, " representation=\"1\""},
     {"outline", {0.15, 0.15, 0.17}, " lineWidth=\"4\""},
     {"band_lines", {0.54, 0.35, 0.0}, " lineWidth=\"2\""},
     {"cut_line", {0.45, 0.12, 0.55}, " lineWidth=\"3\""},
     {"true_outline", {0.0, 0.42, 0.24}, " lineWidth=\"3\""},
     {"way", {0.15, 0.15, 0.17}, " pointSize=\"3\""}}};

/// Elements of a scene, each kind numbered from 1.
class Nodes {
 public:
  /// Its id, "vtkMRML" + kind + "Node" + number.
  std::string add(const std::string& kind, const std::string& name, const std::string& attributes) {
    const std::string id = "vtkMRML" + kind + "Node" + std::to_string(++numbers_[kind]);
    text_ += " <" + kind + " id=\"" + id + "\" name=\"" + name + "\"" + attributes + "></" + kind +
             ">\n";
    return id;
  }
  const std::string& text() const { return text_; }

 private:
  std::map<std::string, int> numbers_;
  std::string text_;
};

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

std::string words_of(const std::array<double, 3>& colour) {
  return text_of(colour[0]) + " " + text_of(colour[1]) + " " + text_of(colour[2]);
}

/// The map of the mean, as the pictures have it; unlit, as light would shift its colours.
std::string map_of(const Run& run) {
  const bool is_detrended = run.tissue.field("mean_detrended") != nullptr;
  const nlohmann::json limits = colour_limits(run).at("mean");
  return attribute("scalarVisibility", "true") +
         attribute("activeScalarName", is_detrended ? "mean_detrended" : "mean") +
         attribute("activeAttributeLocation", "point") + attribute("scalarRangeFlag", "UseManual") +
         attribute("scalarRange",
                   text_of(limits[0].get<double>()) + " " + text_of(limits[1].get<double>())) +
         attribute("colorNodeID", kDiverging) + attribute("lighting", "false");
}

void add_model(Nodes& nodes, const Run& run, const std::string& name, Frame frame) {
  const auto* look =
      std::ranges::find(kLooks, name, [](const Look& one) { return std::string(one.name); });
  require(look != kLooks.end(), "slicer_scene", "the model " + name, "must have a look");
  const std::string storage = nodes.add(
      "ModelStorage", name + "_storage",
      attribute("fileName", name + ".vtp") + attribute("coordinateSystem", name_of(frame)));
  const std::string display =
      nodes.add("ModelDisplay", name + "_display",
                attribute("color", words_of(look->colour)) + look->more +
                    (name == "tissue" ? map_of(run) : attribute("scalarVisibility", "false")));
  nodes.add("Model", name,
            attribute("storageNodeRef", storage) + attribute("displayNodeRef", display));
}

void add_marks(Nodes& nodes, const NamedMarks& list) {
  const std::string colour = words_of(list.colour);
  const std::string storage = nodes.add("MarkupsJsonStorage", list.name + "_storage",
                                        attribute("fileName", list.name + ".mrk.json"));
  const std::string display =
      nodes.add("MarkupsDisplay", list.name + "_display",
                attribute("color", colour) + attribute("selectedColor", colour) +
                    attribute("pointLabelsVisibility", "false") +
                    attribute("useGlyphScale", "false") + attribute("glyphSize", "1"));
  nodes.add("MarkupsFiducial", list.name,
            attribute("storageNodeRef", storage) + attribute("displayNodeRef", display));
}

}  // namespace

std::string slicer_scene(const Run& run, const std::vector<std::string>& models,
                         const std::vector<NamedMarks>& lists, Frame frame) {
  require(frame != Frame::Mesh, "slicer_scene", "frame mesh", "must be RAS or LPS");
  Nodes nodes;
  for (const std::string& model : models) add_model(nodes, run, model, frame);
  for (const NamedMarks& list : lists)
    if (!list.marks.empty()) add_marks(nodes, list);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MRML version=\"Slicer5.0.0\">\n" +
         nodes.text() + "</MRML>\n";
}

}  // namespace palpation::results
