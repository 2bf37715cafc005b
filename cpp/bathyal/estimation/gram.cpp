// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/gram.hpp"

#include <algorithm>
#include <vector>

#include "bathyal/base/parallel.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/estimation/internal/gram_kernel.hpp"

namespace bathyal {
namespace {

using Columns = Eigen::Ref<const Eigen::MatrixXd>;
using Eigen::Index;
using estimation::PlainColumns;

constexpr std::size_t kColumnsOfTask = 96;  ///< their part of a block of rows stays in the cache
constexpr std::size_t kLeastOfTask = 24;    ///< where there would be no work for other threads
constexpr std::size_t kRowsOfTask = 960;    ///< a multiple of what any kernel computes at once

const estimation::Kernels& kernels() {
#if defined(BATHYAL_X86_KERNELS)
  switch (simd_level()) {
    case SimdLevel::kAvx512:
      return estimation::kAvx512;
    case SimdLevel::kAvx2:
      return estimation::kAvx2;
    case SimdLevel::kBaseline:
      break;
  }
#endif
  return estimation::kBaseline;
}

PlainColumns plain(const Columns& columns, Index first, Index count) {
  return {columns.data() + first * columns.outerStride(), columns.outerStride(), count};
}

std::size_t columns_of_task(Index columns) {
  return static_cast<std::size_t>(columns) > 4 * kColumnsOfTask ? kColumnsOfTask : kLeastOfTask;
}

}  // namespace

Eigen::MatrixXd inner_products(const Columns& a, const Columns& b, int num_threads) {
  if (a.cols() > b.cols()) return inner_products(b, a, num_threads).transpose();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  if (a.cols() == 0) return out;
  const estimation::Kernels& kernel = kernels();
  parallel_for(static_cast<std::size_t>(b.cols()), columns_of_task(b.cols()), num_threads,
               [&](std::size_t begin, std::size_t end) {
                 const auto first = static_cast<Index>(begin);
                 const auto count = static_cast<Index>(end - begin);
                 kernel.inner({plain(a, 0, a.cols()), plain(b, first, count), a.rows(),
                               out.col(first).data(), out.outerStride(), nullptr});
               });
  return out;
}

Eigen::MatrixXd inner_products(const Columns& a, int num_threads) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.cols(), a.cols());
  const estimation::Kernels& kernel = kernels();
  parallel_for(static_cast<std::size_t>(a.cols()), columns_of_task(a.cols()), num_threads,
               [&](std::size_t begin, std::size_t end) {
                 const auto first = static_cast<Index>(begin);
                 const auto last = static_cast<Index>(end);
                 kernel.inner({plain(a, 0, last), plain(a, first, last - first), a.rows(),
                               out.col(first).data(), out.outerStride(), nullptr});
               });
  out.triangularView<Eigen::StrictlyLower>() = out.transpose();
  return out;
}

void add_product(const Columns& a, const Columns& b, Eigen::Ref<Eigen::MatrixXd> out,
                 int num_threads) {
  if (a.cols() == 0 || b.cols() == 0) return;
  const estimation::Kernels& kernel = kernels();
  parallel_for(
      static_cast<std::size_t>(a.rows()), kRowsOfTask, num_threads,
      [&](std::size_t begin, std::size_t end) {
        const auto first = static_cast<Index>(begin);
        std::vector<double> scratch(static_cast<std::size_t>(estimation::scratch_size(a.cols())));
        kernel.combine({{a.data() + first, a.outerStride(), a.cols()},
                        plain(b, 0, b.cols()),
                        static_cast<Index>(end - begin),
                        out.data() + first,
                        out.outerStride(),
                        scratch.data()});
      });
}

Eigen::MatrixXd product(const Columns& a, const Columns& b, int num_threads) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_product(a, b, out, num_threads);
  return out;
}

}  // namespace bathyal
