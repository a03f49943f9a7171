/// Which column of a robot's log plays which role, and in which unit.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpation/io/csv.h"
#include "palpation/io/robot_log.h"

namespace palpation {

struct LogColumn {
  std::size_t index = 0;
  double factor = 1.0;  ///< to SI, or to counts
  std::string unit{};   ///< as it is called; empty where a role has none
};

/// By role. Throws as read_robot_log.
std::map<std::string, LogColumn> log_columns(const CsvTable& table, const LogRules& rules);

/// "time: t_s [s], ..."
std::string columns_words(const CsvTable& table, const std::map<std::string, LogColumn>& columns);

}  // namespace palpation
