#include "boundary/tissue_ruler.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/cross.h"

namespace palpation {
namespace {

/// The triangle's edges from its first corner in a plane of its own.
Eigen::Matrix2d edges_on_tissue(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 along = b - a, arm = c - a;
  const double base = along.norm();
  Eigen::Matrix2d edges;
  edges << base, along.dot(arm) / base, 0.0, along.cross(arm).norm() / base;
  return edges;
}

/// The part of a line, from 0 to 1, in a triangle that runs counter-clockwise; empty where the
/// second is not above the first.
std::pair<double, double> part_inside(const std::array<Vec2, 3>& corners, const Vec2& from,
                                      const Vec2& step) {
  double enter = 0.0, leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = corners[(i + 1) % 3] - corners[i];
    const double at_start = cross(edge, from - corners[i]), slope = cross(edge, step);
    if (slope > 0.0)
      enter = std::max(enter, -at_start / slope);
    else if (slope < 0.0)
      leave = std::min(leave, -at_start / slope);
    else if (at_start < 0.0)
      return {1.0, 0.0};
  }
  return {enter, leave};
}

}  // namespace

TissueRuler::TissueRuler(const Surface& surface) {
  const Points2& uv = surface.chart().uv;
  lower_ = uv.colwise().minCoeff();
  const Vec2 extent = uv.colwise().maxCoeff().transpose() - lower_;
  bin_m_ = std::max(std::sqrt(extent.x() * extent.y() / surface.face_count()),
                    extent.maxCoeff() / 4096.0);
  columns_ = static_cast<int>(extent.x() / bin_m_) + 1;
  rows_ = static_cast<int>(extent.y() / bin_m_) + 1;
  faces_.reserve(surface.face_count());
  for (int face = 0; face < surface.face_count(); ++face) {
    const Eigen::Vector3i t = surface.triangle(face);
    const std::array<Vec2, 3> at = {uv.row(t[0]), uv.row(t[1]), uv.row(t[2])};
    Eigen::Matrix2d in_chart;
    in_chart << at[1] - at[0], at[2] - at[0];
    faces_.push_back(
        {at, edges_on_tissue(surface.vertex(t[0]), surface.vertex(t[1]), surface.vertex(t[2])) *
                 in_chart.inverse()});
  }
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for_each_bin([&](int bin, int) { ++first_[bin + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  numbers_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_bin([&](int bin, int face) { numbers_[next[bin]++] = face; });
}

/// Calls what(bin, face) for every bin that a face's box touches, in the order of faces.
template <typename What>
void TissueRuler::for_each_bin(const What& what) const {
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    const std::array<Vec2, 3>& at = faces_[face].corners;
    const Bins bins =
        bins_of(at[0].cwiseMin(at[1]).cwiseMin(at[2]), at[0].cwiseMax(at[1]).cwiseMax(at[2]));
    for (int row = bins.first_row; row <= bins.last_row; ++row) {
      for (int column = bins.first_column; column <= bins.last_column; ++column)
        what(row * columns_ + column, static_cast<int>(face));
    }
  }
}

TissueRuler::Bins TissueRuler::bins_of(const Vec2& low, const Vec2& high) const {
  const auto along = [&](double offset, int count) {
    return static_cast<int>(std::clamp(std::floor(offset / bin_m_), 0.0, count - 1.0));
  };
  return {along(low.x() - lower_.x(), columns_), along(high.x() - lower_.x(), columns_),
          along(low.y() - lower_.y(), rows_), along(high.y() - lower_.y(), rows_)};
}

double TissueRuler::length(const Vec2& from, const Vec2& to) const {
  const Vec2 step = to - from;
  const double whole = step.norm();
  if (whole == 0.0) return 0.0;
  struct Part {
    double enter, leave, length;
  };
  std::vector<Part> parts;
  const Bins box = bins_of(from.cwiseMin(to), from.cwiseMax(to));
  for (int row = box.first_row; row <= box.last_row; ++row) {
    for (int column = box.first_column; column <= box.last_column; ++column) {
      // Bins off the line hold nothing of it.
      const Vec2 middle = lower_ + bin_m_ * Vec2(column + 0.5, row + 0.5);
      const bool inner = column > box.first_column && column < box.last_column &&
                         row > box.first_row && row < box.last_row;
      if (inner && std::abs(cross(step, middle - from)) > whole * bin_m_) continue;
      for (int i = first_[row * columns_ + column]; i < first_[row * columns_ + column + 1]; ++i) {
        const Face& face = faces_[numbers_[i]];
        const auto [enter, leave] = part_inside(face.corners, from, step);
        if (enter < leave) parts.push_back({enter, leave, (face.to_tissue * step).norm()});
      }
    }
  }
  // A face may be in several bins, and a line along an edge is in two faces: each part of the line
  // counts once.
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::tie(a.enter, a.leave, a.length) < std::tie(b.enter, b.leave, b.length);
  });
  double done = 0.0, sum = 0.0;
  for (const Part& part : parts) {
    if (part.enter > done) {
      sum += (part.enter - done) * whole;
      done = part.enter;
    }
    if (part.leave <= done) continue;
    sum += (part.leave - done) * part.length;
    done = part.leave;
  }
  return sum + (1.0 - done) * whole;
}

Eigen::Matrix2d TissueRuler::stretch_at(const Vec2& place) const {
  const Bins box = bins_of(place, place);
  const int bin = box.first_row * columns_ + box.first_column;
  for (int i = first_[bin]; i < first_[bin + 1]; ++i) {
    const Face& face = faces_[numbers_[i]];
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside &&
               cross(face.corners[(k + 1) % 3] - face.corners[k], place - face.corners[k]) >= 0.0;
    if (inside) return face.to_tissue;
  }
  return Eigen::Matrix2d::Identity();
}

}  // namespace palpation
