// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numeric>

#include "bathyal/base/parallel.hpp"
#include "bathyal/estimation/gram.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"

// The rows of tracked poses, one pose at a time.

namespace bathyal {

void ArmResiduals::compare_tracked(Index begin, Index end, const TipRows& out) const {
  const Index count = 3 * (end - begin);
  Eigen::Map<Eigen::Matrix3Xd>(out.tips, 3, end - begin) -=
      m_.position.middleCols(begin, end - begin);
  Eigen::ArrayXd root(count);
  for (Index i = begin; i < end; ++i) {
    root.segment<3>(3 * (i - begin)).setConstant(std::sqrt(weight(i)));
  }
  const auto weigh = [&](double* residuals, double* jacobian, double noise) {
    Eigen::Map<Eigen::ArrayXd>(residuals, count) *= root / noise;
    for (Index c = 0; jacobian != nullptr && c < columns(); ++c) {
      Eigen::Map<Eigen::ArrayXd>(jacobian + c * out.stride, count) *= root / noise;
    }
  };
  weigh(out.tips, out.jacobian, noise_.position);
  for (Index i = begin; i < end; ++i) {
    const Index row = 3 * (i - begin);
    whiten(i, out.tips + row, out.jacobian == nullptr ? nullptr : out.jacobian + row, out.stride);
  }
  if (m_.has_rotation()) weigh(out.rotations, out.rotation_jacobian, noise_.rotation);
}

/// Tracked poses are independent: their rows are computed, used and discarded chunk by chunk.
/// `body(chunk, rows)` receives [J r] of a chunk, J in the units of the parameters.
template <class Body>
void ArmResiduals::for_each_tracked(const double* y, bool derive, const Body& body) const {
  const Eigen::VectorXd x = values(Eigen::Map<const Eigen::VectorXd>(y, columns()));
  const ChainDerivatives chain(parameters_, x, free_);
  const Index kinds = m_.has_rotation() ? 2 : 1;
  parallel_for(static_cast<std::size_t>(m_.rows()), kPosesPerChunk, num_threads_,
               [&](std::size_t begin, std::size_t end) {
                 const auto count = static_cast<Index>(end - begin);
                 const Index width = derive ? columns() : 0;
                 Eigen::MatrixXd rows(3 * kinds * count, width + 1);
                 TipRows out{rows.col(width).data(), derive ? rows.data() : nullptr, nullptr,
                             nullptr, rows.rows()};
                 if (kinds == 2) {
                   out.rotations = out.tips + 3 * count;
                   out.rotation_jacobian = derive ? out.jacobian + 3 * count : nullptr;
                 }
                 fill_tips(chain, static_cast<Index>(begin), static_cast<Index>(end), out);
                 compare_tracked(static_cast<Index>(begin), static_cast<Index>(end), out);
                 body(begin / kPosesPerChunk, rows);
               });
}

/// Sums of each chunk, added in order.
Eigen::MatrixXd ArmResiduals::normal_equations(const double* y) const {
  if (!m_.tracked) return ResidualModel::normal_equations(y);
  const Index width = columns() + 1;
  std::vector<Eigen::MatrixXd> parts((static_cast<std::size_t>(m_.rows()) - 1) / kPosesPerChunk +
                                     1);
  for_each_tracked(y, true, [&](std::size_t chunk, const Eigen::MatrixXd& rows) {
    parts[chunk] = inner_products(rows, 1);
  });
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(width, width);
  for (const Eigen::MatrixXd& kind : parts) sum += kind;
  const Eigen::MatrixXd linear = linear_rows_at(y);
  if (linear.rows() > 0) sum += inner_products(linear, num_threads_);
  Eigen::VectorXd factors(width);
  factors << scales(), 1.0;
  return factors.asDiagonal() * sum * factors.asDiagonal();
}

double ArmResiduals::cost(const double* y) const {
  if (!m_.tracked) return ResidualModel::cost(y);
  std::vector<double> parts((static_cast<std::size_t>(m_.rows()) - 1) / kPosesPerChunk + 1);
  for_each_tracked(y, false, [&](std::size_t chunk, const Eigen::MatrixXd& rows) {
    parts[chunk] = rows.squaredNorm();
  });
  return std::accumulate(parts.begin(), parts.end(), linear_rows_at(y).rightCols(1).squaredNorm());
}

}  // namespace bathyal
