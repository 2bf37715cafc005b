// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/hold_out.hpp"

#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/diagnosis/orthonormal.hpp"

namespace bathyal {
namespace {

/// Share of a direction's square that the other blocks must hold to tell it.
constexpr double kTold = 1e-9;

}  // namespace

HeldOutErrors hold_out(const Eigen::VectorXd& misfit, const Eigen::MatrixXd& columns,
                       const std::vector<int>& unit, const Blocks& blocks, int num_threads) {
  const Eigen::MatrixXd q = orthonormal(columns);
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(blocks.count));
  for (Index r = 0; r < misfit.size(); ++r) {
    if (unit[r] >= 0) rows[blocks.of[unit[r]]].push_back(r);
  }
  HeldOutErrors out{Eigen::VectorXd::Zero(misfit.size()), Eigen::VectorXd::Zero(blocks.count), 0.0};
  for (const std::vector<Index>& block : rows) out.rows += static_cast<double>(block.size());
  const Eigen::VectorXd against = q.transpose() * misfit;
  parallel_for(rows.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      // The square of all rows is 1; that of the others is 1 less the block's.
      const Eigen::MatrixXd part = q(rows[b], Eigen::all);
      const Eigen::VectorXd own = misfit(rows[b]);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> others(
          Eigen::MatrixXd::Identity(q.cols(), q.cols()) - part.transpose() * part);
      Eigen::VectorXd inverse = others.eigenvalues();
      for (double& value : inverse) value = value > kTold ? 1.0 / value : 0.0;
      const Eigen::VectorXd values =
          others.eigenvectors() *
          (inverse.asDiagonal() *
           (others.eigenvectors().transpose() * (against - part.transpose() * own)));
      const Eigen::VectorXd error = own - part * values;
      out.error(rows[b]) = error;
      out.of_block[static_cast<Index>(b)] = error.squaredNorm();
    }
  });
  return out;
}

double sign_flip_p(const Eigen::VectorXd& gains) {
  constexpr Index kAllOf = 16;
  const bool all = gains.size() <= kAllOf;
  const std::uint64_t count = std::uint64_t{1} << static_cast<unsigned>(std::min(gains.size(), kAllOf));
  const double found = gains.sum();
  const double rounding = 1e-12 * gains.cwiseAbs().sum();
  RandomStream random(0);
  std::uint64_t as_large = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    double sum = 0.0;
    for (Index b = 0; b < gains.size(); ++b) {
      const bool flip = all ? (k >> static_cast<unsigned>(b) & 1U) != 0 : random.uniform() < 0.5;
      sum += flip ? -gains[b] : gains[b];
    }
    if (sum >= found - rounding) ++as_large;
  }
  return static_cast<double>(as_large) / static_cast<double>(count);
}

}  // namespace bathyal
