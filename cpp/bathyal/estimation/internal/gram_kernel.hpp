// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// The interface between matrices and the kernels that are compiled once for each instruction set:
// plain numbers and pointers only.

namespace bathyal::estimation {

/// Columns in memory, `stride` numbers from one to the next.
struct PlainColumns {
  const double* first;
  std::ptrdiff_t stride;
  std::ptrdiff_t count;
};

struct Product {
  PlainColumns a;
  PlainColumns b;
  std::ptrdiff_t rows;  ///< of a
  double* out;          ///< columns, added to
  std::ptrdiff_t out_stride;
  double* scratch;  ///< scratch_size(a.count) numbers, of a combination only
};

inline constexpr std::ptrdiff_t kMostRows = 24;  ///< computed at once by a combination

inline std::ptrdiff_t scratch_size(std::ptrdiff_t columns) { return kMostRows * columns; }

struct Kernels {
  void (*inner)(const Product&);    ///< out (a.count, b.count) += aᵀ b, b of `rows` rows
  void (*combine)(const Product&);  ///< out (rows, b.count) += a b, b of a.count rows
};

extern const Kernels kBaseline;
#if defined(BATHYAL_X86_KERNELS)
extern const Kernels kAvx2;
extern const Kernels kAvx512;
#endif

}  // namespace bathyal::estimation
