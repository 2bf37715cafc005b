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

/// Entries below this share of a direction's largest one are rounding, not partners.
constexpr double kPartnerShare = 1e-4;

/// Positions by falling size of their entry, those above the share only.
std::vector<Index> partners(const Eigen::VectorXd& direction) {
  const double least = kPartnerShare * direction.cwiseAbs().maxCoeff();
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

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& rows, int num_threads) {
  const Index columns = rows.cols();
  if (rows.rows() <= std::max(kRowsPerBlock, 2 * columns)) {
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(columns, columns);
    const Index height = std::min(rows.rows(), columns);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows);
    triangle.topRows(height) = qr.matrixQR().topRows(height).triangularView<Eigen::Upper>();
    return triangle;
  }
  const Index block = std::max(kRowsPerBlock, 2 * columns);
  const Index blocks = (rows.rows() + block - 1) / block;
  Eigen::MatrixXd triangles(blocks * columns, columns);
  parallel_for(static_cast<std::size_t>(blocks), 1, num_threads, [&](std::size_t i, std::size_t) {
    const auto first = static_cast<Index>(i) * block;
    triangles.middleRows(static_cast<Index>(i) * columns, columns) =
        triangle_of(rows.middleRows(first, std::min(block, rows.rows() - first)));
  });
  return triangle_of(triangles);
}

Eigen::MatrixXd inverse_square(const Eigen::MatrixXd& jacobian) {
  const Index columns = jacobian.cols();
  const Eigen::MatrixXd inverse = triangle_of(jacobian).triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(columns, columns));
  return inverse * inverse.transpose();
}

RankReport reveal_rank(const Eigen::MatrixXd& jacobian, double tolerance) {
  RankReport report;
  const Index columns = jacobian.cols();
  if (columns == 0) return report;
  const bool square = jacobian.rows() == columns;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(square ? jacobian : triangle_of(jacobian),
                                           Eigen::ComputeFullV);
  report.singular_values = svd.singularValues();
  report.directions = svd.matrixV();
  const double least = tolerance * report.singular_values[0];
  while (report.rank < columns && report.singular_values[report.rank] > least) ++report.rank;
  return report;
}

Eigen::MatrixXd unseen_of(const Eigen::MatrixXd& jacobian) {
  const Index columns = jacobian.cols();
  const Eigen::MatrixXd triangle = triangle_of(jacobian);
  if ((triangle.diagonal().array() != 0.0).all()) {
    const Eigen::MatrixXd inverse =
        triangle.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(columns, columns));
    // The Frobenius norm is no less than the largest singular value.
    if (kRankTolerance * triangle.norm() * inverse.norm() < 1.0) return {columns, 0};
  }
  return reveal_rank(triangle).unseen();
}

std::vector<Eigen::VectorXd> readable_directions(const Eigen::MatrixXd& unseen) {
  // Gauss and Jordan with the largest entry left as the next lead.
  Eigen::MatrixXd rows = unseen.transpose();
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
  return directions.cols() > 0 && directions.row(column).norm() > kUnseenShare;
}

std::vector<Trade> trades_of(int column, const Eigen::MatrixXd& unseen,
                             const std::vector<Column>& columns) {
  std::vector<Trade> trades;
  if (unseen.cols() == 0) return trades;
  const Eigen::VectorXd direction = unseen * unseen.row(column).transpose();
  if (std::abs(direction[column]) < kPartnerShare * kPartnerShare) return trades;
  for (const Index i : partners(direction)) {
    if (i == column) continue;
    const Column& other = columns[i];
    trades.push_back({other.name, other.words,
                      direction[i] * other.scale / (direction[column] * columns[column].scale)});
  }
  return trades;
}

std::string in_words(const Eigen::VectorXd& direction, const std::vector<Column>& columns) {
  std::string text;
  for (const Index i : partners(direction)) {
    char number[32];
    std::snprintf(number, sizeof number, " %+.3g", direction[i]);
    text += (text.empty() ? "" : ", ") + columns[i].words + number;
  }
  return text;
}

namespace {

/// Of the columns `order`, those that bring something new: `least` (passes, columns) is the length
/// from which what is left of a column does, in each pass over all of them.
Selection select_above(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                       const Eigen::MatrixXd& least) {
  // Householder's QR: of the columns that are still left, `rest` has below row `known` what those
  // that were kept cannot do.
  Eigen::MatrixXd rest = jacobian(Eigen::all, order);
  std::vector<char> is_kept(order.size(), 0);
  Selection selection;
  Index known = 0;
  const auto keep = [&](std::size_t taken) {
    const Index below = rest.rows() - known - 1;
    double tau = 0.0;
    double beta = 0.0;
    Eigen::VectorXd reflector(below);
    rest.col(static_cast<Index>(taken)).tail(below + 1).makeHouseholder(reflector, tau, beta);
    is_kept[taken] = 1;
    selection.kept.push_back(order[taken]);
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (is_kept[i]) continue;
      auto column = rest.col(static_cast<Index>(i));
      const double along = tau * (column[known] + reflector.dot(column.tail(below)));
      column[known] -= along;
      column.tail(below) -= along * reflector;
    }
    ++known;
  };
  for (Index pass = 0; pass < least.rows(); ++pass) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double left = rest.col(column).tail(rest.rows() - known).norm();
      if (!is_kept[i] && left > least(pass, column)) keep(i);
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!is_kept[i]) selection.dependent.push_back(order[i]);
  }
  return selection;
}

}  // namespace

Selection select_independent(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                             const std::vector<double>& tolerances) {
  const Eigen::Map<const Eigen::VectorXd> shares(tolerances.data(),
                                                 static_cast<Index>(tolerances.size()));
  return select_above(jacobian, order, shares * jacobian(Eigen::all, order).colwise().norm());
}

Selection select_longer(const Eigen::MatrixXd& jacobian, const std::vector<int>& order,
                        double least) {
  return select_above(jacobian, order,
                      Eigen::RowVectorXd::Constant(static_cast<Index>(order.size()), least));
}

}  // namespace bathyal
