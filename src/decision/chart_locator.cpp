#include "decision/chart_locator.h"

#include <algorithm>
#include <cmath>

#include "base/cross.h"

namespace palpation {
namespace {

constexpr double kForgiven = 1e-9;  // of a barycentric weight

Vec3 weights_in(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& place) {
  const double area = cross(b - a, c - a);
  return Vec3(cross(b - place, c - place), cross(c - place, a - place),
              cross(a - place, b - place)) /
         area;
}

}  // namespace

// About one bin a face; fewer where slivers would lie in too many bins each.
ChartLocator::ChartLocator(const Surface& surface) : surface_(surface), uv_(surface_.chart().uv) {
  lower_ = uv_.colwise().minCoeff();
  upper_ = uv_.colwise().maxCoeff();
  const Vec2 extent = upper_ - lower_;
  const double most = 8.0 * surface_.face_count() + 64.0;
  bin_m_ = std::max(std::sqrt(extent.x() / surface_.face_count()) * std::sqrt(extent.y()),
                    extent.maxCoeff() / surface_.face_count());
  for (;; bin_m_ *= 2.0) {
    columns_ = static_cast<int>(extent.x() / bin_m_) + 1;
    rows_ = static_cast<int>(extent.y() / bin_m_) + 1;
    if (columns_ * rows_ == 1 || entries() <= most) break;
  }
  fill();
}

int ChartLocator::bin_along(double offset, int count) const {
  return static_cast<int>(std::clamp(std::floor(offset / bin_m_), 0.0, count - 1.0));
}

ChartLocator::Bins ChartLocator::bins_of(int face) const {
  const Eigen::Vector3i corners = surface_.triangle(face);
  const Vec2 a = uv_.row(corners[0]), b = uv_.row(corners[1]), c = uv_.row(corners[2]);
  const Vec2 low = a.cwiseMin(b).cwiseMin(c) - lower_, high = a.cwiseMax(b).cwiseMax(c) - lower_;
  const Vec2 margin = kForgiven * (high - low);
  return {bin_along(low.x() - margin.x(), columns_), bin_along(high.x() + margin.x(), columns_),
          bin_along(low.y() - margin.y(), rows_), bin_along(high.y() + margin.y(), rows_)};
}

double ChartLocator::entries() const {
  double count = 0.0;
  for (int face = 0; face < surface_.face_count(); ++face) {
    const Bins bins = bins_of(face);
    count += (1.0 + bins.last_column - bins.first_column) * (1.0 + bins.last_row - bins.first_row);
  }
  return count;
}

void ChartLocator::fill() {
  const auto for_bins = [&](int face, const auto& visit) {
    const Bins bins = bins_of(face);
    for (int row = bins.first_row; row <= bins.last_row; ++row) {
      for (int column = bins.first_column; column <= bins.last_column; ++column)
        visit(row * columns_ + column);
    }
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (int face = 0; face < surface_.face_count(); ++face)
    for_bins(face, [&](int bin) { ++first_[bin + 1]; });
  for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  faces_.resize(first_.back());
  std::vector<int> next = first_;
  for (int face = 0; face < surface_.face_count(); ++face)
    for_bins(face, [&](int bin) { faces_[next[bin]++] = face; });
}

Vec2 ChartLocator::place(const SurfacePoint& point) const {
  const Eigen::Vector3i corners = surface_.triangle(point.face);
  Vec2 place = Vec2::Zero();
  for (int i = 0; i < 3; ++i) place += point.barycentric[i] * uv_.row(corners[i]).transpose();
  return place;
}

std::optional<SurfacePoint> ChartLocator::at(const Vec2& place) const {
  const Vec2 offset = place - lower_;
  const int bin = bin_along(offset.y(), rows_) * columns_ + bin_along(offset.x(), columns_);
  for (int entry = first_[bin]; entry < first_[bin + 1]; ++entry) {
    const Eigen::Vector3i corners = surface_.triangle(faces_[entry]);
    const Vec3 weights =
        weights_in(uv_.row(corners[0]), uv_.row(corners[1]), uv_.row(corners[2]), place);
    if (!(weights.minCoeff() >= -kForgiven)) continue;
    const Vec3 inside = weights.cwiseMax(0.0);
    return SurfacePoint{faces_[entry], inside / inside.sum()};
  }
  return std::nullopt;
}

}  // namespace palpation
