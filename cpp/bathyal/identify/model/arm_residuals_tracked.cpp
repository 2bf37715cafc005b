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

namespace {

Eigen::Matrix3d power_of(const Eigen::Matrix3d& covariance, double power) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Matrix3d turn = eigen.eigenvectors();
  return turn * eigen.eigenvalues().array().pow(power).matrix().asDiagonal() * turn.transpose();
}

/// Of the mean of `count` errors, one for each pose and one that all share.
Eigen::Matrix3d mean_factor(const Eigen::Matrix3d& shared, double count, double power) {
  return power_of(Eigen::Matrix3d::Identity() + count * shared, power);
}

}  // namespace

std::vector<int> ArmResiduals::sharing(const RowWhitening::SharedError& error) const {
  std::vector<int> out = error.poses;
  std::erase_if(out, [this](int pose) { return is_excluded(pose); });
  return out;
}

/// n errors ε + s, of covariances 1 and C, are their mean, of 1 / n + C, and independent deviations
/// from it, of covariance 1.
void ArmResiduals::scale_means(Eigen::Ref<Eigen::MatrixXd> rows, double power) const {
  if (!row_whitening_) return;
  for (const RowWhitening::SharedError& error : row_whitening_->shared) {
    const std::vector<int> poses = sharing(error);
    const auto count = static_cast<double>(poses.size());
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(3, rows.cols());
    for (const int i : poses) mean += rows.middleRows(3 * i, 3) / count;
    const Eigen::MatrixXd change = mean_factor(error.covariance, count, power) * mean - mean;
    for (const int i : poses) rows.middleRows(3 * i, 3) += change;
    const Eigen::Matrix3d alone = mean_factor(error.covariance, 1.0, power);
    for (const int i : error.poses) {
      if (is_excluded(i)) rows.middleRows(3 * i, 3) = alone * rows.middleRows(3 * i, 3).eval();
    }
  }
}

/// Of n poses with an error in common each has 1 / n of its variance from their mean, which is
/// whitened more than what is about it.
Eigen::MatrixXd ArmResiduals::whitened(const Eigen::MatrixXd& loads) const {
  Eigen::MatrixXd about = loads;
  if (!row_whitening_) return about;
  for (Index i = 0; i < m_.rows(); ++i)
    about.middleRows(3 * i, 3) = row_whitening_->factors[i] * loads.middleRows(3 * i, 3);
  if (!has_shared_errors()) return about;
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
  for (const RowWhitening::SharedError& error : row_whitening_->shared) {
    const auto count = static_cast<double>(sharing(error).size());
    for (const int i : error.poses) {
      const double others = is_excluded(i) ? 1.0 : count;
      mean.middleRows(3 * i, 3) = std::sqrt(1.0 / others) *
                                  mean_factor(error.covariance, others, -0.5) *
                                  about.middleRows(3 * i, 3);
      about.middleRows(3 * i, 3) *= std::sqrt(1.0 - 1.0 / others);
    }
  }
  Eigen::MatrixXd out(loads.rows(), 2 * loads.cols());
  out << mean, about;
  return out;
}

Eigen::Matrix3Xd ArmResiduals::errors_of(const Eigen::VectorXd& whitened) const {
  Eigen::MatrixXd rows = whitened;
  scale_means(rows, 0.5);
  Eigen::Matrix3Xd out(3, m_.rows());
  for (Index i = 0; i < m_.rows(); ++i)
    out.col(i) = row_factor(i).ldlt().solve(rows.block<3, 1>(3 * i, 0));
  return out;
}

std::vector<Eigen::Matrix3d> ArmResiduals::error_covariances() const {
  std::vector<Eigen::Matrix3d> out(static_cast<std::size_t>(m_.rows()),
                                   Eigen::Matrix3d::Identity());
  if (row_whitening_) {
    for (const RowWhitening::SharedError& error : row_whitening_->shared) {
      for (const int i : error.poses) out[i] += error.covariance;
    }
  }
  for (Index i = 0; i < m_.rows(); ++i) {
    const Eigen::Matrix3d unit = row_factor(i).inverse();
    out[i] = unit * out[i] * unit.transpose();
  }
  return out;
}

/// Tracked poses without errors in common are independent: their rows are computed, used and
/// discarded chunk by chunk. `body(chunk, rows)` receives [J r] of a chunk, J in the units of the
/// parameters.
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
  if (!m_.tracked || has_shared_errors()) return ResidualModel::normal_equations(y);
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
  if (!m_.tracked || has_shared_errors()) return ResidualModel::cost(y);
  std::vector<double> parts((static_cast<std::size_t>(m_.rows()) - 1) / kPosesPerChunk + 1);
  for_each_tracked(y, false, [&](std::size_t chunk, const Eigen::MatrixXd& rows) {
    parts[chunk] = rows.squaredNorm();
  });
  return std::accumulate(parts.begin(), parts.end(), linear_rows_at(y).rightCols(1).squaredNorm());
}

}  // namespace bathyal
