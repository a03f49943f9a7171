#include "results/markups.h"

#include <nlohmann/json.hpp>

#include "io/length_scale.h"
#include "palpation/base/error.h"

namespace palpation::results {
namespace {

using nlohmann::json;

constexpr const char* kSchema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

json position_mm(const Vec3& place) {
  json position = json::array();
  for (const double coordinate : place)
    position.push_back(from_metres(coordinate, LengthUnit::Millimetre));
  return position;
}

}  // namespace

std::string markups_json(const std::string& name, const std::vector<Mark>& marks, Frame frame,
                         const std::array<double, 3>& colour) {
  require(frame != Frame::Mesh, "markups_json", "frame mesh", "must be RAS or LPS");
  json points = json::array();
  for (std::size_t i = 0; i < marks.size(); ++i) {
    points.push_back({{"id", std::to_string(i + 1)},
                      {"label", marks[i].label},
                      {"description", marks[i].description},
                      {"position", position_mm(marks[i].place)},
                      {"selected", true},
                      {"locked", true},
                      {"visibility", true},
                      {"positionStatus", "defined"}});
  }
  const json list = {{"type", "Fiducial"},
                     {"name", name},
                     {"coordinateSystem", name_of(frame)},
                     {"coordinateUnits", "mm"},
                     {"locked", true},
                     {"labelFormat", "%N-%d"},
                     {"controlPoints", points},
                     {"display",
                      {{"visibility", true},
                       {"color", colour},
                       {"selectedColor", colour},
                       {"propertiesLabelVisibility", false},
                       {"pointLabelsVisibility", false},
                       {"useGlyphScale", false},
                       {"glyphSize", 1.0}}}};
  const json document = {{"@schema", kSchema}, {"markups", json::array({list})}};
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace palpation::results
