#include "results/clip.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "palpation/base/error.h"

namespace palpation::results {
namespace {

/// Builds the part, corner by corner: each point of the whole comes once, and so does the crossing
/// of each edge, so that the part hangs together.
class Clip {
 public:
  Clip(const VtpShape& whole, const std::vector<double>& values, double level, Side side)
      : whole_(whole), values_(values), level_(level), side_(side) {
    for (const auto& [name, unused] : whole.point_fields)
      part_.point_fields.emplace_back(name, std::vector<double>());
  }

  VtpShape part() {
    for (const std::array<int, 3>& triangle : whole_.triangles) {
      corners_.clear();
      for (std::size_t i = 0; i < 3; ++i) take_side(triangle[i], triangle[(i + 1) % 3]);
      for (std::size_t i = 2; i < corners_.size(); ++i)
        part_.triangles.push_back({corners_[0], corners_[i - 1], corners_[i]});
    }
    return std::move(part_);
  }

 private:
  bool is_inside(int point) const {
    return side_ == Side::AtLeast ? values_[point] >= level_ : values_[point] <= level_;
  }

  void take_side(int from, int to) {
    if (is_inside(from)) corners_.push_back(point_of(from, from, 0.0));
    // No number is on neither side, and there is no crossing towards it.
    if (is_inside(from) == is_inside(to) || values_[from] != values_[from] ||
        values_[to] != values_[to])
      return;
    const int low = std::min(from, to), high = std::max(from, to);
    corners_.push_back(
        point_of(low, high, (level_ - values_[low]) / (values_[high] - values_[low])));
  }

  int point_of(int low, int high, double share) {
    const auto [place, is_new] =
        made_.try_emplace({low, high}, static_cast<int>(part_.points.size()));
    if (!is_new) return place->second;
    part_.points.push_back((1.0 - share) * whole_.points[low] + share * whole_.points[high]);
    for (std::size_t i = 0; i < part_.point_fields.size(); ++i) {
      const std::vector<double>& field = whole_.point_fields[i].second;
      part_.point_fields[i].second.push_back((1.0 - share) * field[low] + share * field[high]);
    }
    return place->second;
  }

  const VtpShape& whole_;
  const std::vector<double>& values_;
  double level_;
  Side side_;
  VtpShape part_;
  std::map<std::pair<int, int>, int> made_;
  std::vector<int> corners_;
};

}  // namespace

VtpShape model_of(const Tissue& tissue, const std::vector<std::string>& fields) {
  VtpShape model;
  for (Eigen::Index i = 0; i < tissue.mesh.vertices.rows(); ++i)
    model.points.emplace_back(tissue.mesh.vertices.row(i));
  for (Eigen::Index i = 0; i < tissue.mesh.triangles.rows(); ++i)
    model.triangles.push_back(
        {tissue.mesh.triangles(i, 0), tissue.mesh.triangles(i, 1), tissue.mesh.triangles(i, 2)});
  for (const std::string& name : fields) {
    if (const Field* field = tissue.field(name))
      model.point_fields.emplace_back(name, std::vector<double>(field->begin(), field->end()));
  }
  return model;
}

VtpShape clipped(const VtpShape& whole, const std::string& field, double level, Side side) {
  const auto found =
      std::ranges::find(whole.point_fields, field,
                        [](const auto& named) -> const std::string& { return named.first; });
  require(found != whole.point_fields.end(), "clipped", "field '" + field + "'",
          "must be one of the mesh's");
  return Clip(whole, found->second, level, side).part();
}

double area_m2(const VtpShape& model) {
  double area = 0.0;
  for (const auto& [a, b, c] : model.triangles)
    area +=
        0.5 * (model.points[b] - model.points[a]).cross(model.points[c] - model.points[a]).norm();
  return area;
}

}  // namespace palpation::results
