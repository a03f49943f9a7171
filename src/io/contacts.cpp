#include "palpation/io/contacts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include "io/length_scale.h"
#include "io/measurement_rows.h"
#include "io/point_cloud.h"
#include "palpation/base/error.h"
#include "palpation/io/atomic_file.h"
#include "palpation/io/csv.h"

namespace palpation {
namespace {

constexpr std::array<const char*, 3> kUnits = {"mm", "cm", "m"};
constexpr double kLeastTissue_m = 1e-3, kMostTissue_m = 2.0;

/// Three columns, and the unit that their names end with.
struct Axes {
  std::array<std::size_t, 3> columns{};
  std::string unit;
};

/// `stem` with x, y and z in the place of its '*', bare or with one of the units behind it.
std::optional<Axes> find_axes(const CsvTable& table, const std::string& stem,
                              const std::vector<std::string>& units) {
  for (const std::string& unit : units) {
    Axes axes{{}, unit};
    bool all = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::string name = stem;
      name.replace(name.find('*'), 1, 1, "xyz"[axis]);
      if (!unit.empty()) name += "_" + unit;
      const std::optional<std::size_t> column = find_column(table, name);
      all = all && column;
      if (column) axes.columns[axis] = *column;
    }
    if (all) return axes;
  }
  return std::nullopt;
}

std::optional<Axes> named_axes(const CsvTable& table, const std::vector<std::string>& names) {
  if (names.empty()) return std::nullopt;
  Axes axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes.columns[axis] = column_index(table, names[axis]);
  const std::string& last = names[2];
  const std::size_t mark = last.rfind('_');
  if (mark != std::string::npos && std::count(kUnits.begin(), kUnits.end(), last.substr(mark + 1)))
    axes.unit = last.substr(mark + 1);
  return axes;
}

Axes position_axes(const CsvTable& table, const ContactColumns& columns) {
  if (const auto asked = named_axes(table, columns.position)) return *asked;
  const std::vector<std::string> units = {"", "mm", "cm", "m"};
  for (const char* stem : {"contact_*", "*"}) {
    if (const auto found = find_axes(table, stem, units)) return *found;
  }
  throw IoError(table.name() + ":" + std::to_string(table.header_line()) +
                ": no columns contact_x, contact_y, contact_z or x, y, z, bare or with _mm, _cm or "
                "_m: name them");
}

std::optional<Vec3> vector_at(const CsvTable& table, std::size_t row, const Axes& axes) {
  Vec3 vector;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value =
        number_at(table, row, axes.columns[static_cast<std::size_t>(i)]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    vector[i] = *value;
  }
  return vector;
}

/// Rows of one kind: how many, and the first line.
struct Rows {
  int count = 0, line = 0;
  void take(int at) {
    if (count++ == 0) line = at;
  }
  void tell(const std::string& why, std::vector<std::string>& remarks) const {
    if (count == 0) return;
    remarks.push_back(std::to_string(count) + (count == 1 ? " row " : " rows ") + why +
                      ", the first in line " + std::to_string(line) + ".");
  }
};

/// As palpate readings writes them: nx, ny, nz point out of the tissue there.
bool is_of_readings(const CsvTable& table) {
  return find_column(table, "reading_unit") && find_column(table, "contact") &&
         find_column(table, "probing");
}

class CsvContacts {
 public:
  CsvContacts(const CsvTable& table, const ContactColumns& columns)
      : table_(table), position_(position_axes(table, columns)) {
    const std::vector<std::string> force_units = {"n", "", "N"};
    if (const auto asked = named_axes(table, columns.outward)) {
      normal_ = asked;
      file_.outward_from = "the columns " + columns.outward[0] + ", " + columns.outward[1] + ", " +
                           columns.outward[2];
    } else if (const auto normal = find_axes(table, "normal_*", {""})) {
      normal_ = normal;
      file_.outward_from = "the columns normal_x, normal_y, normal_z";
    } else if (is_of_readings(table)) {
      normal_ = find_axes(table, "n*", {""});
      if (normal_) file_.outward_from = "the columns nx, ny, nz of these readings";
    } else {
      force_ = find_axes(table, "f*", force_units);
    }
    take_unit(columns);
  }

  ContactsFile read() {
    for (std::size_t row = 0; row < table_.row_count(); ++row) take_row(row);
    not_numbers_.tell("left out, without a finite position", file_.remarks);
    no_direction_.tell("with no direction of their own: they take the mean of the others",
                       file_.remarks);
    set_aside_.tell("left out, set aside or missed", file_.remarks);
    drop_repeats();
    fill(file_.points, points_);
    const Vec3 force = force_sum_.stableNormalized();
    if (force_ && !force.isZero(0.0)) {
      file_.outward_from = "the mean force on the probe, taken to point out of the tissue";
      outward_.assign(points_.size(), force);
    }
    give_mean_direction();
    fill(file_.outward, outward_);
    return std::move(file_);
  }

 private:
  void take_unit(const ContactColumns& columns) {
    const std::string in_name = position_.unit;
    unit_ = columns.unit      ? *columns.unit
            : in_name.empty() ? LengthUnit::Metre
                              : length_unit(in_name);
    if (columns.unit && !in_name.empty() && length_unit(in_name) != *columns.unit)
      throw IoError(table_.name() + ":" + std::to_string(table_.header_line()) +
                    ": the columns say " + in_name + ", but another unit was asked for");
    file_.unit_words = columns.unit      ? "the unit that was asked for"
                       : in_name.empty() ? "metres, as no unit is named"
                                         : in_name + ", as its columns say";
  }

  bool is_set_aside(std::size_t row) const {
    const std::optional<std::size_t> kind = find_column(table_, "kind");
    return !set_aside_at(table_, row).empty() || (kind && table_.cell(row, *kind) == "missed");
  }

  void take_row(std::size_t row) {
    const int line = table_.line(row);
    const std::optional<Vec3> place = vector_at(table_, row, position_);
    if (!place) return not_numbers_.take(line);
    if (is_set_aside(row)) return set_aside_.take(line);
    if (normal_) {
      const std::optional<Vec3> normal = vector_at(table_, row, *normal_);
      if (!normal || normal->isZero(0.0)) no_direction_.take(line);
      outward_.push_back(normal ? normal->stableNormalized() : Vec3::Zero());
    }
    if (force_) {
      if (const std::optional<Vec3> force = vector_at(table_, row, *force_)) force_sum_ += *force;
    }
    points_.push_back(place->unaryExpr([&](double value) { return to_metres(value, unit_); }));
    file_.places.push_back(line);
  }

  void give_mean_direction() {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& each : outward_) sum += each;
    if (no_direction_.count > 0 && sum.isZero(0.0)) {  // nothing tells
      outward_.clear();
      file_.outward_from.clear();
    }
    for (Vec3& each : outward_) {
      if (each.isZero(0.0)) each = sum.stableNormalized();
    }
  }

  /// A log says where contact was found in each of a probing's rows: that is one contact.
  void drop_repeats() {
    std::map<std::array<double, 3>, std::size_t> seen;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::array<double, 3> place = {points_[i].x(), points_[i].y(), points_[i].z()};
      if (!seen.emplace(place, kept).second) continue;
      points_[kept] = points_[i];
      file_.places[kept] = file_.places[i];
      if (normal_) outward_[kept] = outward_[i];
      ++kept;
    }
    const std::size_t repeats = points_.size() - kept;
    if (repeats > 0)
      file_.remarks.push_back(std::to_string(repeats) +
                              " rows repeat the place of an earlier one and count once with it.");
    points_.resize(kept);
    file_.places.resize(kept);
    if (normal_) outward_.resize(kept);
  }

  static void fill(Points& rows, const std::vector<Vec3>& vectors) {
    rows.resize(static_cast<Eigen::Index>(vectors.size()), 3);
    for (std::size_t i = 0; i < vectors.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = vectors[i];
  }

  const CsvTable& table_;
  Axes position_;
  std::optional<Axes> normal_, force_;
  LengthUnit unit_ = LengthUnit::Metre;
  ContactsFile file_;
  std::vector<Vec3> points_, outward_;
  Vec3 force_sum_ = Vec3::Zero();
  Rows not_numbers_, no_direction_, set_aside_;
};

/// A header of names and commas, not of numbers.
bool begins_like_csv(std::string_view bytes) {
  const std::string_view line = bytes.substr(0, bytes.find_first_of("\r\n"));
  return line.find(',') != std::string_view::npos &&
         std::any_of(line.begin(), line.end(),
                     [](char letter) { return std::isalpha(static_cast<unsigned char>(letter)); });
}

void check_size(const std::string& name, const ContactsFile& file) {
  if (file.points.rows() == 0) throw IoError(name + ": no contact is left");
  const double size_m =
      (file.points.colwise().maxCoeff() - file.points.colwise().minCoeff()).maxCoeff();
  if (size_m >= kLeastTissue_m && size_m <= kMostTissue_m) return;
  throw IoError(name + ": read in " + file.unit_words + ", the contacts are " + text_of(size_m) +
                " m across, but tissue is between 0.001 m and 2 m: say the unit");
}

}  // namespace

ContactsFile read_contacts(const std::filesystem::path& path, const ContactColumns& columns) {
  for (const std::vector<std::string>& names : {columns.position, columns.outward})
    require(names.empty() || names.size() == 3, "read_contacts",
            std::to_string(names.size()) + " columns", "must be three, or none");
  const std::string bytes = read_file(path);
  const MeshSource source{path, bytes, 0};
  ContactsFile file;
  if (bytes.substr(0, 3) == "ply") {
    file = read_ply_cloud(source, columns);
  } else if (begins_like_csv(bytes)) {
    const CsvTable table = parse_csv(bytes, path.string());
    file = CsvContacts(table, columns).read();
  } else {
    file = read_xyz(source, columns);
  }
  check_size(path.string(), file);
  return file;
}

}  // namespace palpation
