#include "geometry/spectrum.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/tile.h"
#include "geometry/margin.h"
#include "geometry/slow_subspace.h"
#include "geometry/surface_state.h"
#include "palpation/base/error.h"
#include "palpation/base/parallel.h"

namespace palpation {

static_assert(Spectrum::kLanes == kLanes);

namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr int kDense = 600;  // vertices that are solved as a whole
constexpr double kSpare =
    1.2;  // block over the modes that are expected; the filter ends there, too

/// Stiffness and mass in the order of the factor's pivots, and that order.
struct Ordered {
  Sparse stiffness, mass;
  Eigen::PermutationMatrix<Eigen::Dynamic> order;  // of a vertex
};

Ordered in_order_of_elimination(const Laplacian& laplacian) {
  Eigen::AMDOrdering<int> ordering;
  Eigen::PermutationMatrix<Eigen::Dynamic> inverse;
  ordering(laplacian.stiffness.selfadjointView<Eigen::Lower>(), inverse);
  Ordered ordered;
  ordered.order = inverse.inverse();
  ordered.stiffness = laplacian.stiffness.twistedBy(ordered.order);
  ordered.mass = laplacian.mass.twistedBy(ordered.order);
  return ordered;
}

BlockFactor factor_of(const Sparse& matrix) {
  const Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt(matrix);
  const Eigen::VectorXd diagonal = ldlt.vectorD();
  if (ldlt.info() != Eigen::Success || !diagonal.allFinite() || !(diagonal.array() > 0.0).all()) {
    throw NumericalError("spectrum: the Laplacian of the mesh has no factor in double precision");
  }
  const Sparse& lower = ldlt.matrixL().nestedExpression();
  BlockFactor factor;
  factor.column_starts.push_back(0);
  for (int column = 0; column < lower.cols(); ++column) {
    for (Sparse::InnerIterator entry(lower, column); entry; ++entry) {
      if (entry.row() <= column) continue;
      factor.rows.push_back(static_cast<int>(entry.row()));
      factor.values.push_back(entry.value());
    }
    factor.column_starts.push_back(static_cast<int>(factor.rows.size()));
    factor.inverse_diagonal.push_back(1.0 / diagonal[column]);
  }
  factor.panel_starts = panels_of(factor);
  return factor;
}

int count_up_to(const Eigen::VectorXd& values, double greatest) {
  return static_cast<int>(std::upper_bound(values.begin(), values.end(), greatest) -
                          values.begin());
}

/// Eigenvalues below 0 are those of constants, rounded.
Eigen::VectorXd not_negative(const Eigen::VectorXd& values) { return values.cwiseMax(0.0); }

InvalidInput too_many(double modes) {
  return InvalidInput("spectrum: about " + std::to_string(std::lround(modes)) +
                      " modes must be at most " + std::to_string(kMostModes));
}

Spectrum solve_densely(const MetricMesh& mesh, double greatest, int kept) {
  const Laplacian laplacian = laplacian_of(mesh);
  const Ritz all = ritz(Eigen::MatrixXd(laplacian.stiffness), Eigen::MatrixXd(laplacian.mass));
  const int rank = std::max(1, count_up_to(all.values, greatest));
  return {not_negative(all.values.head(rank)), all.weights.topLeftCorner(kept, rank)};
}

}  // namespace

/// Writes modes without a detour over a matrix.
class SpectrumMaker {
 public:
  static Spectrum make(const std::vector<Strip>& block, const Ritz& modes, int rank,
                       const Ordered& ordered, int kept) {
    Spectrum spectrum(not_negative(modes.values.head(rank)), kept);
    const int width = static_cast<int>(modes.weights.rows());
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights =
        -modes.weights.leftCols(rank).transpose();
    const PackedFactor packed(weights.data(), width, rank, width);
    const long given_per_tile = static_cast<long>(width) * kLanes,
               per_tile = static_cast<long>(rank) * kLanes;
    for_ranges(spectrum.tile_count(), 64, [&](int first, int last) {
      std::vector<double> values(static_cast<std::size_t>(kTilesTogether * given_per_tile));
      for (int begin = first; begin < last; begin += kTilesTogether) {
        const int count = std::min(kTilesTogether, last - begin);
        std::fill(values.begin(), values.end(), 0.0);
        for (int vertex = begin * kLanes; vertex < std::min((begin + count) * kLanes, kept);
             ++vertex) {
          const long row = static_cast<long>(ordered.order.indices()[vertex]) * kStrip;
          double* lane =
              values.data() + (vertex / kLanes - begin) * given_per_tile + vertex % kLanes;
          for (int column = 0; column < width; ++column)
            lane[column * kLanes] = block[column / kStrip][row + column % kStrip];
        }
        double* tiles = spectrum.waves_.get() + begin * per_tile;
        std::fill_n(tiles, count * per_tile, 0.0);
        subtract_product(packed, {values.data(), given_per_tile, width}, 0, count, tiles, per_tile);
      }
    });
    return spectrum;
  }
};

Spectrum::Spectrum(Eigen::VectorXd values, int vertex_count)
    : values_(std::move(values)), vertex_count_(vertex_count) {
  waves_ = std::shared_ptr<double[]>(new double[static_cast<std::size_t>(tile_count()) *
                                                static_cast<std::size_t>(rank()) * kLanes]);
}

Spectrum::Spectrum(Eigen::VectorXd values, const Eigen::MatrixXd& waves)
    : Spectrum(std::move(values), static_cast<int>(waves.rows())) {
  for (int vertex = 0; vertex < tile_count() * kLanes; ++vertex) {
    double* lane =
        waves_.get() + static_cast<long>(vertex / kLanes) * rank() * kLanes + vertex % kLanes;
    for (int mode = 0; mode < rank(); ++mode)
      lane[mode * kLanes] = vertex < vertex_count_ ? waves(vertex, mode) : 0.0;
  }
}

Eigen::VectorXd Spectrum::at(int vertex) const {
  Eigen::VectorXd modes(rank());
  const double* lane = tile(vertex / kLanes) + vertex % kLanes;
  for (int mode = 0; mode < rank(); ++mode) modes[mode] = lane[mode * kLanes];
  return modes;
}

double expected_modes(const MetricMesh& mesh, double greatest) {
  double modes = 0.0, border = 0.0;
  for (int face = 0; face < mesh.triangles.rows(); ++face) {
    modes += std::min(area_of(mesh, face) * greatest / (4.0 * std::numbers::pi),
                      0.5);  // two triangles a vertex
    for (int corner = 0; corner < 3; ++corner)
      border += mesh.across(face, corner) < 0 ? mesh.lengths(face, corner) : 0.0;
  }
  return std::min(modes + border * std::sqrt(greatest) / (4.0 * std::numbers::pi) + 1.0,
                  static_cast<double>(mesh.vertex_count));
}

Spectrum spectrum_of(const MetricMesh& mesh, double greatest, int kept) {
  if (mesh.vertex_count <= kDense) return solve_densely(mesh, greatest, kept);
  const double expected = expected_modes(mesh, greatest);
  if (!(expected <= kMostModes)) throw too_many(expected);
  const Ordered ordered = in_order_of_elimination(laplacian_of(mesh));
  const double shift = kShift * greatest;
  const BlockFactor factor = factor_of(ordered.stiffness + shift * ordered.mass);
  const ShiftedLaplacian laplacian{ordered.stiffness, ordered.mass, factor, shift};
  for (double wanted = kSpare * expected + kStrip;; wanted *= 1.4) {
    const int strips = static_cast<int>(std::ceil(wanted / kStrip));
    if (strips * kStrip * 2 > mesh.vertex_count) throw too_many(wanted);
    std::vector<Strip> block = start_block(laplacian, strips);
    filter(block, laplacian, kSpare * greatest);
    const Ritz modes = ritz(gram(block, ordered.stiffness), gram(block, ordered.mass));
    const int rank = count_up_to(modes.values, greatest);
    if (rank * 1.08 < strips * kStrip)
      return SpectrumMaker::make(block, modes, std::max(rank, 1), ordered, kept);
  }
}

std::shared_ptr<const Spectrum> Surface::spectrum(const SpectrumRange& range) const {
  const std::lock_guard lock(state_->spectra_guard);
  std::shared_ptr<const Spectrum>& spectrum = state_->spectra[range];
  if (!spectrum) {
    // A margin only adds modes, and for what is far too short a length it would be far too fine.
    const double expected =
        vertex_count() > kDense ? expected_modes(metric_of(*this), range.greatest) : 0.0;
    if (!(expected <= kMostModes)) throw too_many(expected);
    note_computed("spectrum");
    spectrum = std::make_shared<const Spectrum>(
        spectrum_of(extended(*this, range.margin_m), range.greatest, vertex_count()));
  }
  return spectrum;
}

MetricMesh extended(const Surface& surface, double margin_m) {
  MetricMesh mesh = with_margin(metric_of(surface), surface.border_loops(), margin_m);
  flip_to_delaunay(mesh);
  return mesh;
}

}  // namespace palpation
