/// What robots did before: scanning in rows, and refining where it is hard.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "palpation/geometry/surface.h"
#include "palpation/readings/palpation.h"

namespace palpation {

class ChartLocator;

/// A boustrophedon over the tissue's chart: rows along u's or v's longer extent, spacing_m apart, a
/// place every step_m along the row. What is left over of an extent is shared out at both ends.
/// Places off the tissue are left out. Throws InvalidInput unless both lengths are positive and
/// finite and the scan has at most 1e7 places; and as Surface::chart.
std::vector<SurfacePoint> raster_scan(const Surface& surface, double spacing_m, double step_m);

/// Recursive refinement (Goldman et al. 2013): a coarse grid of cells; a cell whose corner readings
/// straddle the level is cut in four and its new corners are touched next, until cells are no
/// larger than finest_m. Corners off the tissue, and those where nothing was felt, do not count.
///
/// Copies are independent. The level may differ from call to call: cells are then cut as if it had
/// always been the last one.
class RecursiveRefinement {
 public:
  /// The first grid has cells of coarsest_m (the last ones shortened to fit), the finest one of
  /// coarsest_m / 2^k. Throws InvalidInput unless 0 < finest_m <= coarsest_m <= 2^20 finest_m and
  /// the finest grid has at most 1e7 corners; and as Surface::chart.
  RecursiveRefinement(Surface surface, double coarsest_m, double finest_m);

  /// The places to touch next, empty when done. Every place is asked for once: where the answer
  /// does not come before the next call, nothing was felt.
  std::vector<SurfacePoint> next(double level);
  /// What was felt at places of the last next(), which must be within half a finest cell of them.
  /// Palpations that were set aside do not count. Throws InvalidInput for a reading that is not
  /// finite or was not asked for.
  void record(std::span<const Palpation> palpations);

 private:
  struct Cell {
    int column, row, size;  // in units of the finest grid
  };
  enum class State : unsigned char { Unknown, Asked, Felt, Silent };
  struct Node {
    State state = State::Unknown;
    double reading = 0.0;
  };

  int node(int column, int row) const { return row * (columns_ + 1) + column; }
  int nearest_node(const SurfacePoint& where) const;
  Vec2 position(int column, int row) const;
  std::array<int, 4> corners(const Cell& cell) const;
  std::vector<Cell> cut(const Cell& region, int size) const;
  bool straddles(const Cell& cell, double level) const;
  bool ask(const Cell& cell, std::vector<SurfacePoint>& places);

  std::shared_ptr<const ChartLocator> tissue_;
  double finest_step_m_;
  int coarsest_size_ = 1;  // in units of the finest grid
  int columns_, rows_;
  std::vector<Node> nodes_;  // (columns + 1) x (rows + 1)
};

}  // namespace palpation
