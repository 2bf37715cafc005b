// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/rank.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bathyal/base/parallel.hpp"

namespace bathyal {

using Eigen::Index;

namespace {

constexpr Index kRowsPerBlock = 1024;

/// Entries below this share of the largest entry of a direction are rounding errors.
constexpr double kEntryShare = 1e-4;

/// Indices by descending size of their entry, without those below the share.
std::vector<Index> sorted_entries(const Eigen::VectorXd& direction) {
  const double least = kEntryShare * direction.cwiseAbs().maxCoeff();
  std::vector<Index> order;
  for (Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction[i]) > least) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(direction[a]) > std::abs(direction[b]);
  });
  return order;
}

}  // namespace

Eigen::MatrixXd qr_factor(const Eigen::MatrixXd& rows, int num_threads) {
  const Index columns = rows.cols();
  if (rows.rows() <= std::max(kRowsPerBlock, 2 * columns)) {
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(columns, columns);
    const Index height = std::min(rows.rows(), columns);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows);
    factor.topRows(height) = qr.matrixQR().topRows(height).triangularView<Eigen::Upper>();
    return factor;
  }
  const Index block = std::max(kRowsPerBlock, 2 * columns);
  const Index blocks = (rows.rows() + block - 1) / block;
  Eigen::MatrixXd factors(blocks * columns, columns);
  parallel_for(static_cast<std::size_t>(blocks), 1, num_threads, [&](std::size_t i, std::size_t) {
    const auto first = static_cast<Index>(i) * block;
    factors.middleRows(static_cast<Index>(i) * columns, columns) =
        qr_factor(rows.middleRows(first, std::min(block, rows.rows() - first)));
  });
  return qr_factor(factors);
}

Eigen::MatrixXd column_space(const Eigen::MatrixXd& jacobian, double tolerance, int num_threads) {
  const Eigen::MatrixXd factor = qr_factor(jacobian, num_threads);
  const Eigen::VectorXd scale = factor.colwise().norm().transpose().unaryExpr(
      [](double length) { return length > 0.0 ? 1.0 / length : 0.0; });
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(tolerance);
  qr.compute(factor * scale.asDiagonal());
  const Index rank = qr.rank();
  Eigen::MatrixXd basis =
      jacobian * (scale.asDiagonal() * Eigen::MatrixXd(qr.colsPermutation())).leftCols(rank);
  qr.matrixR()
      .topLeftCorner(rank, rank)
      .triangularView<Eigen::Upper>()
      .solveInPlace<Eigen::OnTheRight>(basis);
  return basis;
}

Eigen::MatrixXd covariance_from_qr(const Eigen::MatrixXd& jacobian) {
  const Index columns = jacobian.cols();
  const Eigen::MatrixXd inverse = qr_factor(jacobian).triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(columns, columns));
  return inverse * inverse.transpose();
}

RankReport numerical_rank(const Eigen::MatrixXd& jacobian, double tolerance) {
  RankReport report;
  const Index columns = jacobian.cols();
  if (columns == 0) return report;
  const bool is_factor = jacobian.rows() == columns;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(is_factor ? jacobian : qr_factor(jacobian),
                                           Eigen::ComputeFullV);
  report.singular_values = svd.singularValues();
  report.directions = svd.matrixV();
  const double least = tolerance * report.singular_values[0];
  while (report.rank < columns && report.singular_values[report.rank] > least) ++report.rank;
  return report;
}

Eigen::MatrixXd null_space_of(const Eigen::MatrixXd& jacobian) {
  const Index columns = jacobian.cols();
  const Eigen::MatrixXd factor = qr_factor(jacobian);
  if ((factor.diagonal().array() != 0.0).all()) {
    const Eigen::MatrixXd inverse =
        factor.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(columns, columns));
    // The Frobenius norm is no less than the largest singular value.
    if (kRankTolerance * factor.norm() * inverse.norm() < 1.0) return {columns, 0};
  }
  return numerical_rank(factor).null_space();
}

std::vector<Eigen::VectorXd> readable_directions(const Eigen::MatrixXd& null_space) {
  // Gauss-Jordan elimination with the largest remaining entry as the next pivot.
  Eigen::MatrixXd rows = null_space.transpose();
  for (Index k = 0; k < rows.rows(); ++k) {
    Index row = 0;
    Index column = 0;
    rows.bottomRows(rows.rows() - k).cwiseAbs().maxCoeff(&row, &column);
    rows.row(k).swap(rows.row(k + row));
    rows.row(k) /= rows(k, column);
    for (Index other = 0; other < rows.rows(); ++other) {
      if (other != k) rows.row(other) -= rows(other, column) * rows.row(k);
    }
  }
  std::vector<Eigen::VectorXd> directions;
  for (Index k = 0; k < rows.rows(); ++k) directions.emplace_back(rows.row(k).transpose());
  return directions;
}

bool takes_part(Index column, const Eigen::MatrixXd& directions) {
  return directions.cols() > 0 && directions.row(column).norm() > kNullSpaceShare;
}

std::vector<NullSpacePartner> null_space_partners(int column, const Eigen::MatrixXd& null_space,
                                                  const std::vector<Parameter>& parameters) {
  std::vector<NullSpacePartner> partners;
  if (null_space.cols() == 0) return partners;
  const Eigen::VectorXd direction = null_space * null_space.row(column).transpose();
  if (std::abs(direction[column]) < kEntryShare * kEntryShare) return partners;
  for (const Index i : sorted_entries(direction)) {
    if (i == column) continue;
    const Parameter& other = parameters[i];
    partners.push_back(
        {other.name, other.description,
         direction[i] * other.scale / (direction[column] * parameters[column].scale)});
  }
  return partners;
}

std::string describe_direction(const Eigen::VectorXd& direction,
                               const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Index i : sorted_entries(direction)) {
    char number[32];
    std::snprintf(number, sizeof number, " %+.3g", direction[i]);
    text += (text.empty() ? "" : ", ") + parameters[i].description + number;
  }
  return text;
}

namespace {

/// Selects columns in the `order` given: in each pass over all of them those whose component
/// orthogonal to the kept ones is longer than `least` (passes, columns).
IndependentColumns select_above(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                                const Eigen::MatrixXd& least) {
  // Householder QR: below row `kept_count`, `remaining` holds the part of each column that is
  // orthogonal to the kept ones.
  Eigen::MatrixXd remaining = jacobian(Eigen::all, order);
  std::vector<char> is_kept(order.size(), 0);
  IndependentColumns out;
  Index kept_count = 0;
  const auto keep = [&](std::size_t next) {
    const Index below = remaining.rows() - kept_count - 1;
    double tau = 0.0;
    double beta = 0.0;
    Eigen::VectorXd reflector(below);
    remaining.col(static_cast<Index>(next)).tail(below + 1).makeHouseholder(reflector, tau, beta);
    is_kept[next] = 1;
    out.kept.push_back(order[next]);
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (is_kept[i]) continue;
      auto column = remaining.col(static_cast<Index>(i));
      const double along = tau * (column[kept_count] + reflector.dot(column.tail(below)));
      column[kept_count] -= along;
      column.tail(below) -= along * reflector;
    }
    ++kept_count;
  };
  for (Index pass = 0; pass < least.rows(); ++pass) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double remainder = remaining.col(column).tail(remaining.rows() - kept_count).norm();
      if (!is_kept[i] && remainder > least(pass, column)) keep(i);
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!is_kept[i]) out.dependent.push_back(order[i]);
  }
  return out;
}

}  // namespace

IndependentColumns select_independent(const Eigen::MatrixXd& jacobian,
                                      const std::vector<int>& order,
                                      const std::vector<double>& tolerances) {
  const Eigen::Map<const Eigen::VectorXd> shares(tolerances.data(),
                                                 static_cast<Index>(tolerances.size()));
  return select_above(jacobian, order, shares * jacobian(Eigen::all, order).colwise().norm());
}

IndependentColumns select_longer(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                                 double least) {
  return select_above(jacobian, order,
                      Eigen::RowVectorXd::Constant(static_cast<Index>(order.size()), least));
}

}  // namespace bathyal
