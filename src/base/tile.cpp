// Compiled with contraction to fused multiply-add, where the instruction set has it
// (CMakeLists.txt).
#include "base/tile.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "base/tile_kernels.h"

namespace palpation {
namespace {

constexpr std::size_t kMostPanelRows = 12;

/// What one instruction set offers.
struct Kernels {
  int panel_rows;
  void (*subtract_strips)(const Panel& panel, const TileRows* strips, int strip_count, int tile,
                          double* fresh);
  void (*subtract_packed)(const PackedPanel& panel, const TileRows* strips, int strip_count,
                          long tile, int tile_count, double* fresh, long per_tile);
  void (*add_sums)(const double* values, int rows, const double* weights, long stride,
                   int weight_count, double* sums);
  void (*exponentials)(double* values, long count);
};

/// The loops over vectors of `width` doubles in functions of one target, and their table; `tiles`:
/// how many fill its registers.
#define PALPATION_KERNELS(name, attribute, width, most_rows, tiles)                                \
  attribute void subtract_strips_##name(const Panel& panel, const TileRows* strips,                \
                                        int strip_count, int tile, double* fresh) {                \
    subtract_strips_by<width>(panel, strips, strip_count, tile, fresh,                             \
                              std::make_integer_sequence<int, most_rows>());                       \
  }                                                                                                \
  attribute void subtract_packed_##name(const PackedPanel& panel, const TileRows* strips,          \
                                        int strip_count, long tile, int tile_count, double* fresh, \
                                        long per_tile) {                                           \
    subtract_packed_by<width, tiles>(panel, strips, strip_count, tile, tile_count, fresh,          \
                                     per_tile, std::make_integer_sequence<int, most_rows>());      \
  }                                                                                                \
  attribute void add_sums_##name(const double* values, int rows, const double* weights,            \
                                 long stride, int count, double* sums) {                           \
    add_sums_by<width>(values, rows, weights, stride, count, sums,                                 \
                       std::make_integer_sequence<int, kMostWeights + 1>());                       \
  }                                                                                                \
  attribute void exponentials_##name(double* values, long count) {                                 \
    exponentials_of<width>(values, count);                                                         \
  }                                                                                                \
  constexpr Kernels k_##name{most_rows, subtract_strips_##name, subtract_packed_##name,            \
                             add_sums_##name, exponentials_##name};

PALPATION_KERNELS(baseline, , 2, 3, 1)
#if defined(__GNUC__) && defined(__x86_64__)
PALPATION_KERNELS(v3, __attribute__((target("avx2,fma"))), 4, 6, 1)
PALPATION_KERNELS(v4, __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,fma"))), 8, 12, 2)

const Kernels& best() {
  __builtin_cpu_init();
  const bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_v4 = has_v3 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512bw");
  const char* wanted = std::getenv("PALPATION_ISA");
  const std::string_view isa = wanted ? wanted : "";
  if (isa == "baseline" || !has_v3) return k_baseline;
  return isa == "v3" || !has_v4 ? k_v3 : k_v4;
}
#else
const Kernels& best() { return k_baseline; }
#endif

const Kernels& kernels() {
  static const Kernels& chosen = best();
  return chosen;
}

}  // namespace

int panel_rows() { return kernels().panel_rows; }

void subtract_strips(const Panel& panel, const TileRows* strips, int strip_count, int tile,
                     double* fresh) {
  kernels().subtract_strips(panel, strips, strip_count, tile, fresh);
}

PackedFactor::PackedFactor(const double* factor, long row_stride, int rows, long columns,
                           long column_stride)
    : rows_(rows), columns_(columns) {
  const int panels = (rows + kernels().panel_rows - 1) / kernels().panel_rows;
  height_ = panels > 0 ? (rows + panels - 1) / panels : 0;
  values_.reserve(rows * columns);
  for (int row = 0; row < rows; row += height_) {
    const int count = std::min(height_, rows - row);
    for (long column = 0; column < columns; ++column) {
      for (int r = 0; r < count; ++r)
        values_.push_back(factor[(row + r) * row_stride + column * column_stride]);
    }
  }
  for (int row = 0; row < rows && rows <= columns; ++row)
    inverse_pivots_.push_back(1.0 /
                              factor[row * row_stride + (columns - rows + row) * column_stride]);
}

PackedPanel PackedFactor::panel(int row, long column, bool solves) const {
  const int count = std::min(height_, rows_ - row);
  return {values_.data() + row * columns_ + column * count, count,
          solves ? inverse_pivots_.data() + row : nullptr};
}

void subtract_packed(const PackedPanel& panel, const TileRows* strips, int strip_count, long tile,
                     int tile_count, double* fresh, long per_tile) {
  kernels().subtract_packed(panel, strips, strip_count, tile, tile_count, fresh, per_tile);
}

void subtract_product(const PackedFactor& factor, const TileRows& known, long tile, int tile_count,
                      double* fresh, long per_tile) {
  for (int row = 0; row < factor.rows(); row += factor.height()) {
    for (int done = 0; done < known.depth; done += kDepthTogether) {
      TileRows strip = known.without_first(done);
      strip.depth = std::min(strip.depth, kDepthTogether);
      subtract_packed(factor.panel(row, done, false), &strip, 1, tile, tile_count,
                      fresh + static_cast<long>(row) * kLanes, per_tile);
    }
  }
}

void solve_triangle(const PackedFactor& factor, double* fresh, int tile_count, long per_tile) {
  const long first = factor.columns() - factor.rows();
  for (int row = 0; row < factor.rows(); row += factor.height()) {
    for (int done = 0; done <= row; done += kDepthTogether) {
      const TileRows own{fresh + static_cast<long>(done) * kLanes, per_tile,
                         std::min(row - done, kDepthTogether)};
      const bool is_last = done + kDepthTogether > row;
      subtract_packed(factor.panel(row, first + done, is_last), &own, 1, 0, tile_count,
                      fresh + static_cast<long>(row) * kLanes, per_tile);
    }
  }
}

void subtract_product(const double* factor, int stride, const double* tile, int depth,
                      double* fresh, int rows) {
  const TileRows strip{tile, 0, depth};
  const int most = panel_rows();
  for (int row = 0; row < rows; row += most) {
    const Panel panel{factor + row * static_cast<long>(stride), stride, std::min(most, rows - row)};
    kernels().subtract_strips(panel, &strip, 1, 0, fresh + row * kLanes);
  }
}

void solve_triangle(const double* factor, int stride, double* fresh, int rows) {
  const int most = panel_rows();
  std::array<double, kMostPanelRows> inverse_pivots{};
  for (int row = 0; row < rows; row += most) {
    const int count = std::min(most, rows - row);
    const double* panel = factor + row * static_cast<long>(stride);
    for (int r = 0; r < count; ++r)
      inverse_pivots[r] = 1.0 / panel[r * static_cast<long>(stride) + row + r];
    const TileRows known{fresh, 0, row};
    kernels().subtract_strips({panel, stride, count, inverse_pivots.data()}, &known, 1, 0,
                              fresh + row * kLanes);
  }
}

void add_sums(const double* values, int rows, const double* weights, long stride, int weight_count,
              double* sums) {
  kernels().add_sums(values, rows, weights, stride, weight_count, sums);
}

void exponentials(double* values, long count) { kernels().exponentials(values, count); }

}  // namespace palpation
