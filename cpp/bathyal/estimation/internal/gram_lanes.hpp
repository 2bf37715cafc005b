// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/base/lanes.hpp"
#include "bathyal/estimation/internal/gram_kernel.hpp"

// Products of tall matrices: written once, compiled for each instruction set. Every number is the
// same sum in the same order for any width and tile size, without fused multiply-add, so that all
// instruction sets give the same bytes.

namespace bathyal::estimation {

/// Up to `N` columns; missing ones repeat the last column, and their results are discarded.
template <int N>
struct Tile {
  const double* column[N];
  int count;
  Tile(const PlainColumns& from, std::ptrdiff_t first) {
    const std::ptrdiff_t remaining = from.count - first;
    count = remaining < N ? static_cast<int>(remaining) : N;
    for (int i = 0; i < N; ++i) {
      column[i] = from.first + (first + (i < count ? i : count - 1)) * from.stride;
    }
  }
};

inline constexpr int kSums = 8;                     ///< row r of a block goes to sum r mod 8
inline constexpr std::ptrdiff_t kRowsAtOnce = 512;  ///< a multiple of it, for the cache

template <class V>
inline void inner_tile(const Tile<V::kInnerA>& a, const Tile<V::kInnerB>& b, std::ptrdiff_t begin,
                       std::ptrdiff_t end, double (&sums)[V::kInnerA][V::kInnerB][kSums]) {
  using D = typename V::D;
  const std::ptrdiff_t whole = begin + (end - begin) / kSums * kSums;
  for (int part = 0; part < kSums; part += V::kLanes) {
    D total[V::kInnerA][V::kInnerB] = {};
    for (std::ptrdiff_t r = begin + part; r < whole; r += kSums) {
      D left[V::kInnerA];
      for (int i = 0; i < V::kInnerA; ++i) left[i] = load<V>(a.column[i] + r);
      for (int j = 0; j < V::kInnerB; ++j) {
        const D right = load<V>(b.column[j] + r);
        for (int i = 0; i < V::kInnerA; ++i) total[i][j] += left[i] * right;
      }
    }
    for (int i = 0; i < V::kInnerA; ++i) {
      for (int j = 0; j < V::kInnerB; ++j) store<V>(sums[i][j] + part, total[i][j]);
    }
  }
  for (int i = 0; i < V::kInnerA; ++i) {
    for (int j = 0; j < V::kInnerB; ++j) {
      for (std::ptrdiff_t r = whole; r < end; ++r) {
        sums[i][j][r - whole] += a.column[i][r] * b.column[j][r];
      }
    }
  }
}

template <class V>
void inner(const Product& p) {
  double s[V::kInnerA][V::kInnerB][kSums];
  for (std::ptrdiff_t begin = 0; begin < p.rows; begin += kRowsAtOnce) {
    const std::ptrdiff_t end = begin + kRowsAtOnce < p.rows ? begin + kRowsAtOnce : p.rows;
    for (std::ptrdiff_t i0 = 0; i0 < p.a.count; i0 += V::kInnerA) {
      const Tile<V::kInnerA> a(p.a, i0);
      for (std::ptrdiff_t j0 = 0; j0 < p.b.count; j0 += V::kInnerB) {
        const Tile<V::kInnerB> b(p.b, j0);
        inner_tile<V>(a, b, begin, end, s);
        for (int j = 0; j < b.count; ++j) {
          double* out = p.out + (j0 + j) * p.out_stride + i0;
          for (int i = 0; i < a.count; ++i) {
            const double* t = s[i][j];
            out[i] += ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
          }
        }
      }
    }
  }
}

template <class V>
void combine(const Product& p) {
  using D = typename V::D;
  constexpr int kHigh = V::kCombineVectors, kWide = V::kCombineColumns;
  constexpr std::ptrdiff_t kRows = kHigh * V::kLanes;
  static_assert(kRows <= kMostRows);
  for (std::ptrdiff_t first = 0; first < p.rows; first += kRows) {
    const std::ptrdiff_t rows = p.rows - first < kRows ? p.rows - first : kRows;
    for (std::ptrdiff_t k = 0; k < p.a.count; ++k) {
      const double* from = p.a.first + k * p.a.stride + first;
      double* to = p.scratch + k * kRows;
      for (std::ptrdiff_t r = 0; r < kRows; ++r) to[r] = r < rows ? from[r] : 0.0;
    }
    for (std::ptrdiff_t j0 = 0; j0 < p.b.count; j0 += kWide) {
      const Tile<kWide> b(p.b, j0);
      D total[kHigh][kWide] = {};
      for (std::ptrdiff_t k = 0; k < p.a.count; ++k) {
        D left[kHigh];
        for (int i = 0; i < kHigh; ++i) left[i] = load<V>(p.scratch + k * kRows + i * V::kLanes);
        for (int j = 0; j < kWide; ++j) {
          const double right = b.column[j][k];
          for (int i = 0; i < kHigh; ++i) total[i][j] += left[i] * right;
        }
      }
      for (int j = 0; j < b.count; ++j) {
        double made[kRows];
        for (int i = 0; i < kHigh; ++i) store<V>(made + i * V::kLanes, total[i][j]);
        double* out = p.out + (j0 + j) * p.out_stride + first;
        for (std::ptrdiff_t r = 0; r < rows; ++r) out[r] += made[r];
      }
    }
  }
}

}  // namespace bathyal::estimation
