/// Distances along the surface.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"

namespace palpation {

/// From every vertex to the nearest of the sources, walking along the surface; infinite where none
/// can be reached, and beyond radius_m. Exact for the mesh: straight lines on a planar convex
/// surface, else by unfolding sequences of faces (Chen and Han 1990, Xin and Wang 2009, with light
/// that bends at a vertex kept to where no shorter way leads past it). Unfolding looks at what is
/// within the radius only: of 40,000 vertices all take 1 s on a dome and 4 s on a saddle, those
/// within 5 mm 0.01 s. Throws InvalidInput without sources or if one is no point of the surface, or
/// if the radius is not positive.
Field distance_from(const Surface& surface, std::span<const SurfacePoint> sources,
                    double radius_m = std::numeric_limits<double>::infinity());

/// Between places, a symmetric matrix with zeros on its diagonal; infinite where no way leads.
/// Straight on a planar surface, holes or not. Elsewhere fast and good to a percent: fronts march
/// over the mesh, from each two known corners of a face to the third as if light came straight from
/// one place of the face's plane (after Kimmel and Sethian 1998). Never less than the straight line
/// through space. Throws InvalidInput if one is no point of the surface.
Eigen::MatrixXd distances_between(const Surface& surface, std::span<const SurfacePoint> places);

/// The vertices less than radius_m away from a vertex, itself included, rising: straight on a
/// planar surface, elsewhere along the surface. Throws InvalidInput for a vertex or radius that is
/// none.
std::vector<int> vertices_near(const Surface& surface, int vertex, double radius_m);

}  // namespace palpation
