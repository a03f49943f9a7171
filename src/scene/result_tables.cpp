#include "scene/result_tables.h"

#include <optional>

#include "palpation/base/error.h"

namespace palpation::tool {
namespace {

constexpr double kMm2 = 1e6;  // in a square metre
constexpr double kMm = 1e3;   // in a metre

std::string cell(const std::optional<double>& value, double factor = 1.0) {
  return value ? text_of(*value * factor) : "";
}

}  // namespace

std::string trace_csv(const Trace& trace, double search_area_m2) {
  std::string text = "batch,measurements,path_mm,level,expected_error_mm2,error_percent\n";
  for (const TraceRow& row : trace) {
    text +=
        std::to_string(row.batch) + "," + std::to_string(row.measurements) + "," +
        text_of(row.path_m * kMm) + "," + cell(row.level) + "," +
        cell(row.expected_error_m2, kMm2) + "," +
        (row.error ? text_of(100.0 * row.error->symmetric_difference_m2 / search_area_m2) : "") +
        "\n";
  }
  return text;
}

std::string waypoint_csv(const std::vector<Waypoint>& waypoints, const std::vector<int>* legs) {
  std::string text =
      "index,x,y,z,approach_x,approach_y,approach_z,indented_x,indented_y,indented_z,normal_x,"
      "normal_y,normal_z,qx,qy,qz,qw,expected_force_"
      "n";
  text += legs != nullptr ? ",leg\n" : "\n";
  Eigen::Vector4d last = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    // Of the two quaternions of a pose the one nearer to the last: who filters them must not see
    // them jump.
    Eigen::Vector4d turn = quaternion(waypoint.rotation);
    if (turn.dot(last) < 0.0) turn = -turn;
    last = turn;
    text += std::to_string(i);
    for (const Vec3& triple :
         {waypoint.position, waypoint.approach, waypoint.indented, waypoint.normal}) {
      for (double coordinate : triple) text += "," + text_of(coordinate);
    }
    for (double coefficient : turn) text += "," + text_of(coefficient);
    text += "," + text_of(waypoint.expected_force_n);
    if (legs != nullptr) text += "," + std::to_string((*legs)[i]);
    text += "\n";
  }
  return text;
}

}  // namespace palpation::tool
