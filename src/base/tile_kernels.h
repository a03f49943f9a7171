/// The loops of tile.h over vectors of W doubles, to be inlined into a function of each instruction
/// set. R rows stay in registers.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#include "base/tile.h"

#define PALPATION_INLINE inline __attribute__((always_inline))

namespace palpation {

template <int W>
struct Vectors {
  // As typedefs: GCC 12 drops the attribute from an alias whose size depends on a template's
  // argument.
  typedef double Doubles __attribute__((vector_size(W * sizeof(double))));
  typedef std::int64_t Integers __attribute__((vector_size(W * sizeof(double))));
  typedef float Floats __attribute__((vector_size(W * sizeof(float))));
  static constexpr int kParts = kLanes / W;
};

template <int W>
PALPATION_INLINE void load(const double* from, typename Vectors<W>::Doubles& to) {
  std::memcpy(&to, from, sizeof to);
}

template <int W>
PALPATION_INLINE void load(const float* from, typename Vectors<W>::Doubles& to) {
  typename Vectors<W>::Floats singles;
  std::memcpy(&singles, from, sizeof singles);
  to = __builtin_convertvector(singles, typename Vectors<W>::Doubles);
}

template <int W>
PALPATION_INLINE void store(const typename Vectors<W>::Doubles& from, double* to) {
  std::memcpy(to, &from, sizeof from);
}

/// sums[r] -= sum_i factor[r * stride + i] values[i] over `depth` rows of one tile; `ahead`: where
/// those of the next tile are.
template <int W, int R, typename Value>
PALPATION_INLINE void subtract_rows(const double* factor, long stride, const Value* values,
                                    const Value* ahead, int depth,
                                    typename Vectors<W>::Doubles (&sums)[R][Vectors<W>::kParts]) {
  constexpr int P = Vectors<W>::kParts;
  for (int i = 0; i < depth; ++i) {
    typename Vectors<W>::Doubles row[P];
    for (int p = 0; p < P; ++p) load<W>(values + i * kLanes + p * W, row[p]);
    __builtin_prefetch(ahead + i * kLanes);
    for (int r = 0; r < R; ++r) {
      for (int p = 0; p < P; ++p) sums[r][p] -= factor[r * stride + i] * row[p];
    }
  }
}

template <int W, int R>
PALPATION_INLINE void subtract_strips_of(const Panel& panel, const TileRows* strips,
                                         int strip_count, int tile, double* fresh) {
  constexpr int P = Vectors<W>::kParts;
  typename Vectors<W>::Doubles sums[R][P];
  for (int r = 0; r < R; ++r) {
    for (int p = 0; p < P; ++p) load<W>(fresh + r * kLanes + p * W, sums[r][p]);
  }
  const double* factor = panel.factor;
  const long stride = panel.stride;
  for (int s = 0; s < strip_count; ++s) {
    const TileRows here = strips[s].from_tile(tile), next = strips[s].from_tile(tile + 1);
    if (here.singles) {
      subtract_rows<W, R>(factor, stride, here.singles, next.singles, here.depth, sums);
    } else {
      subtract_rows<W, R>(factor, stride, here.values, next.values, here.depth, sums);
    }
    factor += here.depth;
  }
  if (panel.inverse_pivots) {
    for (int i = 0; i < R; ++i) {
      for (int p = 0; p < P; ++p) sums[i][p] *= panel.inverse_pivots[i];
      for (int r = i + 1; r < R; ++r) {
        for (int p = 0; p < P; ++p) sums[r][p] -= factor[r * stride + i] * sums[i][p];
      }
    }
  }
  for (int r = 0; r < R; ++r) {
    for (int p = 0; p < P; ++p) store<W>(sums[r][p], fresh + r * kLanes + p * W);
  }
}

/// sums[r][q] -= sum_i factor[i * R + r] values[i] over `depth` rows of T tiles, T * kParts vectors
/// side by side.
template <int W, int R, int T, typename Value>
PALPATION_INLINE void subtract_packed_rows(
    const double* factor, const Value* values, const Value* ahead, long per_tile, int depth,
    typename Vectors<W>::Doubles (&sums)[R][T * Vectors<W>::kParts]) {
  constexpr int P = Vectors<W>::kParts;
  for (int i = 0; i < depth; ++i) {
    typename Vectors<W>::Doubles row[T * P];
    for (int t = 0; t < T; ++t) {
      for (int p = 0; p < P; ++p) load<W>(values + t * per_tile + p * W, row[t * P + p]);
      __builtin_prefetch(ahead + t * per_tile);
    }
    for (int r = 0; r < R; ++r) {
      for (int q = 0; q < T * P; ++q) sums[r][q] -= factor[r] * row[q];
    }
    factor += R;
    values += kLanes;
    ahead += kLanes;
  }
}

template <int W, int R, int T>
PALPATION_INLINE void subtract_packed_of(const PackedPanel& panel, const TileRows* strips,
                                         int strip_count, long tile, double* fresh, long per_tile) {
  constexpr int P = Vectors<W>::kParts;
  typename Vectors<W>::Doubles sums[R][T * P];
  for (int r = 0; r < R; ++r) {
    for (int t = 0; t < T; ++t) {
      for (int p = 0; p < P; ++p)
        load<W>(fresh + t * per_tile + r * kLanes + p * W, sums[r][t * P + p]);
    }
  }
  const double* factor = panel.factor;
  for (int s = 0; s < strip_count; ++s) {
    const TileRows here = strips[s].from_tile(tile), next = strips[s].from_tile(tile + T);
    if (here.singles) {
      subtract_packed_rows<W, R, T>(factor, here.singles, next.singles, here.per_tile, here.depth,
                                    sums);
    } else {
      subtract_packed_rows<W, R, T>(factor, here.values, next.values, here.per_tile, here.depth,
                                    sums);
    }
    factor += static_cast<long>(here.depth) * R;
  }
  if (panel.inverse_pivots) {
    for (int i = 0; i < R; ++i) {
      for (int q = 0; q < T * P; ++q) {
        sums[i][q] *= panel.inverse_pivots[i];
        for (int r = i + 1; r < R; ++r) sums[r][q] -= factor[i * R + r] * sums[i][q];
      }
    }
  }
  for (int r = 0; r < R; ++r) {
    for (int t = 0; t < T; ++t) {
      for (int p = 0; p < P; ++p)
        store<W>(sums[r][t * P + p], fresh + t * per_tile + r * kLanes + p * W);
    }
  }
}

/// T tiles at a time, then what is left.
template <int W, int R, int T>
PALPATION_INLINE void subtract_packed_tiles(const PackedPanel& panel, const TileRows* strips,
                                            int strip_count, long tile, int tile_count,
                                            double* fresh, long per_tile) {
  int done = 0;
  for (; done + T <= tile_count; done += T)
    subtract_packed_of<W, R, T>(panel, strips, strip_count, tile + done, fresh + done * per_tile,
                                per_tile);
  for (; T > 1 && done < tile_count; ++done)
    subtract_packed_of<W, R, 1>(panel, strips, strip_count, tile + done, fresh + done * per_tile,
                                per_tile);
}

template <int W, int T, int... R>
PALPATION_INLINE void subtract_packed_by(const PackedPanel& panel, const TileRows* strips,
                                         int strip_count, long tile, int tile_count, double* fresh,
                                         long per_tile, std::integer_sequence<int, R...>) {
  (void)((panel.rows == R + 1 &&
          (subtract_packed_tiles<W, R + 1, T>(panel, strips, strip_count, tile, tile_count, fresh,
                                              per_tile),
           true)) ||
         ...);
}

template <int W, int... R>
PALPATION_INLINE void subtract_strips_by(const Panel& panel, const TileRows* strips,
                                         int strip_count, int tile, double* fresh,
                                         std::integer_sequence<int, R...>) {
  (void)((panel.rows == R + 1 &&
          (subtract_strips_of<W, R + 1>(panel, strips, strip_count, tile, fresh), true)) ||
         ...);
}

/// Squares and M weighted sums.
template <int W, int M>
PALPATION_INLINE void add_sums_of(const double* values, int rows, const double* weights,
                                  long stride, double* sums) {
  constexpr int P = Vectors<W>::kParts;
  typename Vectors<W>::Doubles totals[1 + M][P];
  for (int j = 0; j <= M; ++j) {
    for (int p = 0; p < P; ++p) load<W>(sums + j * kLanes + p * W, totals[j][p]);
  }
  for (int r = 0; r < rows; ++r) {
    for (int p = 0; p < P; ++p) {
      typename Vectors<W>::Doubles row;
      load<W>(values + r * kLanes + p * W, row);
      totals[0][p] += row * row;
      for (int j = 0; j < M; ++j) totals[1 + j][p] += weights[j * stride + r] * row;
    }
  }
  for (int j = 0; j <= M; ++j) {
    for (int p = 0; p < P; ++p) store<W>(totals[j][p], sums + j * kLanes + p * W);
  }
}

template <int W, int... M>
PALPATION_INLINE void add_sums_by(const double* values, int rows, const double* weights,
                                  long stride, int weight_count, double* sums,
                                  std::integer_sequence<int, M...>) {
  (void)((weight_count == M && (add_sums_of<W, M>(values, rows, weights, stride, sums), true)) ||
         ...);
}

/// e^x = 2^k e^r, k the integer nearest to x / ln 2, |r| <= ln 2 / 2, e^r by its Taylor polynomial
/// of degree 13 (its remainder is below 5e-18). 2^k is multiplied on in two halves, so that a
/// result below the least normal number is rounded once.
template <int W>
PALPATION_INLINE void exponentials_of(double* values, long count) {
  using Doubles = typename Vectors<W>::Doubles;
  using Integers = typename Vectors<W>::Integers;
  constexpr double kLog2e = 0x1.71547652b82fep0;
  constexpr double kLn2High = 0x1.62e42fefa0000p-1,
                   kLn2Low = 0x1.cf79abc9e3b3ap-40;  // the first times 2^11 is exact
  constexpr double kRound = 0x1.8p52;                // pushes what follows the point out
  constexpr double kMost = 710.0, kLeast = -746.0;   // beyond: infinite, and 0
  for (long i = 0; i < count; i += W) {
    Doubles x;
    load<W>(values + i, x);
    x = x > kMost ? Doubles{} + kMost : x;
    x = x < kLeast ? Doubles{} + kLeast : x;
    const Doubles k = (x * kLog2e + kRound) - kRound;
    const Doubles r = (x - k * kLn2High) - k * kLn2Low;
    Doubles sum = Doubles{} + 1.0 / 6227020800.0;
    for (const double coefficient :
         {1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0,
          1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5}) {
      sum = sum * r + coefficient;
    }
    const Doubles power = (sum * r) * r + r;  // e^r - 1
    // A number plus 1.5 2^52 + 1023 carries its biased exponent in its last bits.
    constexpr double kBias = kRound + 1023.0;
    const Doubles half = (k * 0.5 + kRound) - kRound;
    const Doubles biased[2] = {half + kBias, (k - half) + kBias};
    Integers bits[2];
    std::memcpy(bits, biased, sizeof bits);
    for (Integers& exponent : bits) exponent <<= 52;
    Doubles scale[2];
    std::memcpy(scale, bits, sizeof scale);
    store<W>((power * scale[0] + scale[0]) * scale[1], values + i);
  }
}

}  // namespace palpation
