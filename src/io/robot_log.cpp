#include "palpation/io/robot_log.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "io/log_columns.h"
#include "io/log_order.h"
#include "io/log_units.h"
#include "io/number_text.h"
#include "palpation/base/error.h"
#include "palpation/io/csv.h"
#include "readings/robust.h"

namespace palpation {
namespace {

constexpr double kFarthest_m = 1000.0;
constexpr double kGreatestForce = 1e12;

bool is_not_recorded(std::string_view cell) {
  if (cell.empty()) return true;
  if (cell.size() > 5) return false;
  const std::string word = lower(cell);
  for (const char* none : {"nan", "na", "n/a", "null", "none", "-", "--", "inf", "-inf", "+inf"})
    if (word == none) return true;
  return false;
}

/// Lines of one kind of fault, for one sentence.
class Lines {
 public:
  void add(int line) {
    if (++count_ <= 3) words_ += (words_.empty() ? "" : ", ") + std::to_string(line);
  }
  int count() const { return count_; }
  std::string words() const {
    return std::string(count_ == 1 ? "line " : "lines ") + words_ +
           (count_ > 3 ? " and others" : "");
  }

 private:
  int count_ = 0;
  std::string words_;
};

class Reader {
 public:
  Reader(const CsvTable& table, const LogRules& rules)
      : table_(table),
        rules_(rules),
        columns_(log_columns(table, rules)),
        stamps_are_large_(are_stamps_large()) {}

  LogFile read(const std::vector<std::string>& torn_rows) {
    for (std::size_t row = 0; row < table_.row_count(); ++row) {
      if (is_copy(row)) {
        copies_.add(table_.line(row));
        continue;
      }
      if (const auto fault = fault_of(row)) {
        if (faults_.count() == 0) first_fault_ = *fault;
        faults_.add(table_.line(row));
        continue;
      }
      rows_.push_back(row);
    }
    if (rows_.empty())
      throw IoError(table_.name() + ": no row is left that could be read" +
                    (!first_fault_.empty() ? ": " + first_fault_
                     : !torn_rows.empty()  ? ": " + torn_rows.front()
                                           : ""));
    LogFile file;
    fill(file.log);
    file.names_probings = has("probe");
    file.has_depth = has("depth");
    file.counts_only = file.log.force_unit != "N";
    tell(file, torn_rows);
    for (std::string& remark : put_in_order(file.log, sample_)) file.remarks.push_back(remark);
    return file;
  }

 private:
  bool has(const std::string& role) const { return columns_.contains(role); }

  bool is_copy(std::size_t row) const {
    if (row == 0) return false;
    for (std::size_t column = 0; column < table_.columns().size(); ++column)
      if (table_.cell(row, column) != table_.cell(row - 1, column)) return false;
    return true;
  }

  /// In the log's unit; not a number where nothing was recorded.
  double value_at(std::size_t row, const LogColumn& column) const {
    if (is_not_recorded(table_.cell(row, column.index))) return std::nan("");
    return parse_number(table_.cell(row, column.index)).value * column.factor;
  }

  static bool is_name(const std::string& role) { return role == "probe" || role == "session"; }

  /// What keeps a row from being a sample.
  std::optional<std::string> fault_of(std::size_t row) const {
    for (const auto& [role, column] : columns_) {
      const std::string_view cell = table_.cell(row, column.index);
      if (is_name(role) || is_not_recorded(cell)) continue;
      const std::string start = "line " + std::to_string(table_.line(row)) + ": column " +
                                table_.columns()[column.index] + ": " + in_quotes(cell);
      const ParsedNumber number = parse_number(cell);
      const bool is_tiny = number.status == NumberStatus::Underflow;
      if (number.status != NumberStatus::Fine && !is_tiny) return start + " is not a number";
      const double size = std::abs(number.value * column.factor);
      const bool is_force = role[0] == 'f' || role == "count";
      if (role != "time" && role != "sample" && size > (is_force ? kGreatestForce : kFarthest_m))
        return start + (is_force ? " is no force" : " lies more than 1000 m away");
    }
    if (!has("time")) return std::nullopt;
    const double time_s = value_at(row, columns_.at("time"));
    if (std::isnan(time_s)) return "line " + std::to_string(table_.line(row)) + ": no stamp";
    if (time_s == 0.0 && stamps_are_large_)
      return "line " + std::to_string(table_.line(row)) + ": a stamp of 0, which is invalid";
    return std::nullopt;
  }

  /// Stamps count from long ago, so that 0 is none of them: one that is neither large nor small is.
  bool are_stamps_large() const {
    if (!has("time")) return false;
    std::vector<double> stamps;
    for (std::size_t row = 0; row < table_.row_count(); ++row) {
      const double stamp = std::abs(value_at(row, columns_.at("time")));
      if (!std::isnan(stamp)) stamps.push_back(stamp);
    }
    return !stamps.empty() && median(stamps) > 1e6;
  }

  Eigen::VectorXd vector_of(const std::string& role) const {
    if (!has(role)) return {};
    Eigen::VectorXd values(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = value_at(rows_[i], columns_.at(role));
    return values;
  }

  /// Three columns; a z that is missing is 0.
  Points points_of(const std::string& x, const std::string& y, const std::string& z) const {
    if (!has(x)) return Points(0, 3);
    Points points = Points::Zero(static_cast<Eigen::Index>(rows_.size()), 3);
    points.col(0) = vector_of(x);
    points.col(1) = vector_of(y);
    if (has(z)) points.col(2) = vector_of(z);
    return points;
  }

  void fill(RobotLog& log) {
    for (const std::size_t row : rows_) log.line.push_back(table_.line(row));
    log.time_s = vector_of("time");
    // Stamps since 1970 leave few digits for what lies between samples: counted from the first.
    if (log.time_s.size() > 0 && stamps_are_large_) {
      first_stamp_s_ = log.time_s[0];
      log.time_s.array() -= first_stamp_s_;
    }
    log.position_m = points_of("x", "y", "z");
    log.depth_m = vector_of("depth");
    log.force = points_of("fx", "fy", "fz");
    log.force_along = vector_of(has("count") ? "count" : "force");
    log.normal = points_of("nx", "ny", "nz");
    log.contact_m = points_of("contact_x", "contact_y", "contact_z");
    sample_ = vector_of("sample");
    fill_names(log);
    const bool counts =
        has("count") || unit_of("force").starts_with("c") || unit_of("fx").starts_with("c");
    if (!counts) return;
    log.force_unit = rules_.gain > 0.0 || rules_.gain < 0.0 ? "N" : "counts";
    const double gain = log.force_unit == "N" ? rules_.gain : 1.0;
    log.force_along = gain * (log.force_along.array() - rules_.offset);
    log.force = gain * (log.force.array() - rules_.offset);
  }

  std::string unit_of(const std::string& role) const {
    return has(role) ? columns_.at(role).unit : std::string();
  }

  void fill_names(RobotLog& log) const {
    std::unordered_map<std::string, int> numbers;
    for (const std::size_t row : rows_) {
      if (has("probe")) {
        const std::string name(table_.cell(row, columns_.at("probe").index));
        const auto [known, is_new] = numbers.try_emplace(name, static_cast<int>(numbers.size()));
        if (is_new) log.names.push_back(name);
        log.probing.push_back(known->second);
      }
      if (!rules_.session.empty())
        log.session.push_back(rules_.session);
      else if (has("session"))
        log.session.emplace_back(table_.cell(row, columns_.at("session").index));
    }
  }

  void tell(LogFile& file, const std::vector<std::string>& torn_rows) const {
    file.remarks.push_back("Columns: " + columns_words(table_, columns_) +
                           (has("z") ? "." : "; no z: it is taken as 0."));
    if (first_stamp_s_ != 0.0)
      file.remarks.push_back("Times count from the first stamp, " + text_of(first_stamp_s_) +
                             " s.");
    if (!torn_rows.empty())
      file.remarks.push_back(std::to_string(torn_rows.size()) +
                             (torn_rows.size() == 1 ? " row was" : " rows were") +
                             " left out: " + torn_rows.front() + ".");
    if (faults_.count() > 0)
      file.remarks.push_back(std::to_string(faults_.count()) +
                             (faults_.count() == 1 ? " row was" : " rows were") + " left out (" +
                             faults_.words() + "): " + first_fault_ + ".");
    if (copies_.count() > 0)
      file.remarks.push_back(std::to_string(copies_.count()) +
                             (copies_.count() == 1 ? " row repeats the one before and was"
                                                   : " rows repeat the one before and were") +
                             " left out: " + copies_.words() + ".");
  }

  const CsvTable& table_;
  const LogRules& rules_;
  std::map<std::string, LogColumn> columns_;
  bool stamps_are_large_;
  std::vector<std::size_t> rows_;
  Eigen::VectorXd sample_;
  double first_stamp_s_ = 0.0;
  Lines faults_, copies_;
  std::string first_fault_;
};

}  // namespace

LogFile read_robot_log(const std::filesystem::path& path, const LogRules& rules) {
  std::vector<std::string> torn_rows;
  const CsvTable table = read_csv(path, &torn_rows);
  return Reader(table, rules).read(torn_rows);
}

LogFile parse_robot_log(std::string_view text, const std::string& name, const LogRules& rules) {
  std::vector<std::string> torn_rows;
  const CsvTable table = parse_csv(text, name, &torn_rows);
  return Reader(table, rules).read(torn_rows);
}

}  // namespace palpation
