// Compiled with contraction to fused multiply-add, where the instruction set has it (CMakeLists.txt).
#include "palpation/base/tile.h"

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
  void (*subtract_strips)(const Panel& panel, const TileRows* strips, int strip_count, int tile, double* fresh);
  void (*add_sums)(const double* values, int rows, const double* weights, long stride, int weight_count, double* sums);
  void (*exponentials)(double* values, long count);
};

/// The three loops over vectors of `width` doubles in functions of one target, and their table.
#define PALPATION_KERNELS(name, attribute, width, most_rows)                                                                    \
  attribute void subtract_strips_##name(const Panel& panel, const TileRows* strips, int strip_count, int tile, double* fresh) { \
    subtract_strips_by<width>(panel, strips, strip_count, tile, fresh, std::make_integer_sequence<int, most_rows>());           \
  }                                                                                                                             \
  attribute void add_sums_##name(const double* values, int rows, const double* weights, long stride, int count, double* sums) { \
    add_sums_by<width>(values, rows, weights, stride, count, sums, std::make_integer_sequence<int, kMostWeights + 1>());        \
  }                                                                                                                             \
  attribute void exponentials_##name(double* values, long count) { exponentials_of<width>(values, count); }                     \
  constexpr Kernels k_##name{most_rows, subtract_strips_##name, add_sums_##name, exponentials_##name};

PALPATION_KERNELS(baseline, , 2, 3)
#if defined(__GNUC__) && defined(__x86_64__)
PALPATION_KERNELS(v3, __attribute__((target("avx2,fma"))), 4, 6)
PALPATION_KERNELS(v4, __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,fma"))), 8, 12)

const Kernels& best() {
  __builtin_cpu_init();
  const bool has_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_v4 = has_v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
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

void subtract_strips(const Panel& panel, const TileRows* strips, int strip_count, int tile, double* fresh) {
  kernels().subtract_strips(panel, strips, strip_count, tile, fresh);
}

void subtract_product(const double* factor, int stride, const double* tile, int depth, double* fresh, int rows) {
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
    for (int r = 0; r < count; ++r) inverse_pivots[r] = 1.0 / panel[r * static_cast<long>(stride) + row + r];
    const TileRows known{fresh, 0, row};
    kernels().subtract_strips({panel, stride, count, inverse_pivots.data()}, &known, 1, 0, fresh + row * kLanes);
  }
}

void add_sums(const double* values, int rows, const double* weights, long stride, int weight_count, double* sums) {
  kernels().add_sums(values, rows, weights, stride, weight_count, sums);
}

void exponentials(double* values, long count) { kernels().exponentials(values, count); }

}  // namespace palpation
