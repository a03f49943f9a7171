/// The innermost loops over the vertices, of the posterior and of a surface's waves: rows of values
/// over tiles of eight vertices, one cache line a row.
///
/// Compiled for several instruction sets, of which the best that the machine has is chosen when the
/// program starts, or the one that the environment names: PALPATION_ISA=baseline, v3 (AVX2) or v4
/// (AVX-512). The last two give the same digits; the first rounds more often.
#pragma once

#include <vector>

namespace palpation {

inline constexpr int kLanes = 8;

/// Rows of kLanes values over tiles, known already: those of tile t are `depth` rows from values +
/// t * per_tile on.
struct TileRows {
  const double* values = nullptr;
  long per_tile = 0;
  int depth = 0;
  const float* singles = nullptr;  ///< in place of values: the same in single precision

  /// Where a row of a tile lies.
  const void* address(long tile, int row) const {
    const long at = tile * per_tile + row * kLanes;
    return singles ? static_cast<const void*>(singles + at) : values + at;
  }
  /// Without the first `rows` rows of every tile.
  TileRows without_first(long rows) const {
    return {values ? values + rows * kLanes : nullptr, per_tile, depth - static_cast<int>(rows),
            singles ? singles + rows * kLanes : nullptr};
  }
  /// The same rows, seen from another tile.
  TileRows from_tile(long tile) const {
    return {values ? values + tile * per_tile : nullptr, per_tile, depth,
            singles ? singles + tile * per_tile : nullptr};
  }
};

/// Rows of a lower triangular factor, `rows` of them, no more than panel_rows(): coefficients of
/// the strips' rows one after another, then, if there are reciprocals of its diagonal, those of the
/// triangle.
struct Panel {
  const double* factor = nullptr;
  long stride = 0;
  int rows = 0;
  const double* inverse_pivots = nullptr;
};

/// How many rows fit the machine's registers.
int panel_rows();

/// On tile `tile`: fresh[r] -= sum_i factor[r, i] strips[i], and then, with pivots, fresh = T^-1
/// fresh, T the triangle. Asks for the next tile of the strips from memory meanwhile.
void subtract_strips(const Panel& panel, const TileRows* strips, int strip_count, int tile,
                     double* fresh);

/// As Panel, the coefficients of each column side by side.
struct PackedPanel {
  const double* factor = nullptr;
  int rows = 0;
  const double* inverse_pivots = nullptr;
};

/// Rows of coefficients in panels of equal height, packed once for many tiles.
class PackedFactor {
 public:
  /// Coefficients factor[row * row_stride + column * column_stride]; if they end in a lower
  /// triangle, that can be solved.
  PackedFactor(const double* factor, long row_stride, int rows, long columns,
               long column_stride = 1);

  int rows() const { return rows_; }
  long columns() const { return columns_; }
  int height() const { return height_; }
  /// The panel that begins with row `row`, from a column on; with `solves` up to its triangle,
  /// which is then solved.
  PackedPanel panel(int row, long column, bool solves) const;

 private:
  int rows_, height_ = 0;
  long columns_;
  std::vector<double> values_, inverse_pivots_;
};

/// So many tiles should take their turns with a panel while it is in the nearest cache, ...
inline constexpr int kTilesTogether = 8;
/// ... and so many of its columns at a time.
inline constexpr int kDepthTogether = 256;

/// As subtract_strips, on tiles from `tile` on, whose rows in `fresh` lie per_tile apart.
void subtract_packed(const PackedPanel& panel, const TileRows* strips, int strip_count, long tile,
                     int tile_count, double* fresh, long per_tile);

/// fresh[r] -= sum_i factor[r, i] known[i], i < known.depth, for all rows of a factor without a
/// triangle, on tiles from `tile` on.
void subtract_product(const PackedFactor& factor, const TileRows& known, long tile, int tile_count,
                      double* fresh, long per_tile);

/// Solves T fresh = fresh in place, T the triangle at the factor's end, on tiles that lie per_tile
/// apart.
void solve_triangle(const PackedFactor& factor, double* fresh, int tile_count, long per_tile);

/// fresh[r] -= sum_i factor[r * stride + i] * tile[i], for `rows` rows of kLanes values each, i <
/// depth.
void subtract_product(const double* factor, int stride, const double* tile, int depth,
                      double* fresh, int rows);

/// Solves T fresh = fresh in place, T the lower triangle factor[r * stride + i], i <= r < rows.
void solve_triangle(const double* factor, int stride, double* fresh, int rows);

inline constexpr int kMostWeights = 5;

/// sums[0] += row^2 and sums[1 + j] += weights[j * stride + r] row_r over `rows` rows, j <
/// weight_count <= kMostWeights.
void add_sums(const double* values, int rows, const double* weights, long stride, int weight_count,
              double* sums);

/// e to the power of each of `count` values, a multiple of kLanes, in place: to two units in the
/// last place over the whole range, infinities and numbers below the least normal one included; NaN
/// stays NaN.
void exponentials(double* values, long count);

}  // namespace palpation
