// The names by which the columns of a robot's log are known.
#include "palpation/io/robot_log.h"

namespace palpation {

const std::vector<std::pair<std::string, std::vector<std::string>>>& log_roles() {
  const auto axis = [](const std::string& k) {
    return std::vector<std::string>{
        k,          "p" + k,     "pos_" + k, "position_" + k,    "tip_" + k,     "p_" + k,
        k + "_tip", "tool_" + k, k + "_pos", "translation_" + k, k + "_position"};
  };
  const auto force = [](const std::string& k) {
    return std::vector<std::string>{"f" + k, "f_" + k, "force_" + k, k + "_force"};
  };
  const auto normal = [](const std::string& k) {
    return std::vector<std::string>{"n" + k, "n_" + k, "normal_" + k};
  };
  const auto contact = [](const std::string& k) {
    return std::vector<std::string>{"contact_" + k, "c" + k, "contact_point_" + k, "touch_" + k,
                                    "surface_" + k};
  };
  static const std::vector<std::pair<std::string, std::vector<std::string>>> roles = {
      {"time", {"t", "time", "stamp", "timestamp", "time_stamp", "header_stamp", "elapsed"}},
      {"x", axis("x")},
      {"y", axis("y")},
      {"z", axis("z")},
      {"depth",
       {"depth", "d", "indentation", "indent", "displacement", "penetration", "indentation_depth",
        "delta"}},
      {"force", {"force", "f", "fn", "normal_force", "force_normal", "f_normal", "load"}},
      {"fx", force("x")},
      {"fy", force("y")},
      {"fz", force("z")},
      {"count", {"count", "counts", "adc", "raw", "reading", "sensor", "raw_counts", "adc_counts"}},
      {"nx", normal("x")},
      {"ny", normal("y")},
      {"nz", normal("z")},
      {"contact_x", contact("x")},
      {"contact_y", contact("y")},
      {"contact_z", contact("z")},
      {"probe",
       {"probe", "probing", "poke", "press", "probe_id", "probing_id", "indentation_id", "poke_id",
        "probe_number", "touch", "point", "point_id", "location", "row", "trial"}},
      {"sample", {"sample", "index", "seq", "sample_id", "header_seq"}},
      {"session", {"session", "run", "session_id"}},
  };
  return roles;
}

}  // namespace palpation
