/// The slow waves of a surface: eigenfunctions of its Laplacian, G phi = lambda M phi, up to a
/// greatest eigenvalue.
///
/// Found by a filtered, randomized subspace (Halko, Martinsson and Tropp 2011; Zhou and Saad 2007):
/// a block of vectors that look white over the surface and follow from its shape alone, filtered by
/// a Chebyshev polynomial in c (G + c M)^-1 M, whose one real factor serves all, then one dense
/// Rayleigh-Ritz step. So the kernels move with an irregular mesh to rounding, whatever its place,
/// scale and numbers; on a mesh so regular that neighbours are alike, numbers of vertices tell them
/// apart, and matter as much as what the modes left out hold. Small meshes are solved densely as a
/// whole. The surface is extended by a margin beyond its borders first (a flat continuation, see
/// the class below), so that kernels made of these waves do not feel the border.
#pragma once

#include <memory>
#include <vector>

#include "geometry/laplacian.h"
#include "palpation/geometry/surface_point.h"

namespace palpation {

/// What is wanted of a spectrum.
struct SpectrumRange {
  double greatest = 0.0;  ///< eigenvalue, 1/m2
  double margin_m = 0.0;  ///< by how much borders are extended
  auto operator<=>(const SpectrumRange&) const = default;
};

/// The modes of one surface at its vertices, orthonormal in area over the extended surface: sum
/// over modes of phi(x) phi(y) f(lambda) is the kernel of f of the Laplacian, 1/m2.
class Spectrum {
 public:
  static constexpr int kLanes = 8;

  /// `waves`: vertices x modes.
  Spectrum(Eigen::VectorXd values, const Eigen::MatrixXd& waves);

  int rank() const { return static_cast<int>(values_.size()); }
  int vertex_count() const { return vertex_count_; }
  const Eigen::VectorXd& values() const {
    return values_;
  }  ///< eigenvalues, 1/m2, in increasing order

  /// For eight vertices from 8 * number on, rank rows of eight lanes; lanes beyond the last vertex
  /// are 0.
  const double* tile(int number) const {
    return waves_.get() + static_cast<long>(number) * rank() * kLanes;
  }
  int tile_count() const { return (vertex_count_ + kLanes - 1) / kLanes; }

  /// All modes at a vertex.
  Eigen::VectorXd at(int vertex) const;

 private:
  friend class SpectrumMaker;
  Spectrum(Eigen::VectorXd values, int vertex_count);

  Eigen::VectorXd values_;
  int vertex_count_;
  std::shared_ptr<double[]> waves_;
};

/// Greatest number of modes that is still a spectrum and not a burden.
inline constexpr int kMostModes = 1500;

/// How many modes there are up to an eigenvalue, about (Weyl's law, and no more than the mesh can
/// carry).
double expected_modes(const MetricMesh& mesh, double greatest);

/// All modes with eigenvalues up to `greatest`, at the first `kept` vertices of the mesh. Errors of
/// the kernels they make are below 1e-4 of its greatest value. Throws InvalidInput where there
/// would be more than kMostModes, NumericalError where the factor fails.
Spectrum spectrum_of(const MetricMesh& mesh, double greatest, int kept);

/// The mesh that a surface's spectrum is taken from: extended, then flipped.
MetricMesh extended(const Surface& surface, double margin_m);

}  // namespace palpation
