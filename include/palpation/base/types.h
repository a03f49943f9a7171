/// The few plain types that every floor shares. All lengths are metres, all areas square metres,
/// all angles radians.
#pragma once

#include <Eigen/Core>

namespace palpation {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// One row a point: n x 3, metres.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One row a point of a chart: n x 2, metres.
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// One row a triangle: m x 3 indices of vertices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// One value per vertex of a surface.
using Field = Eigen::VectorXd;

}  // namespace palpation
