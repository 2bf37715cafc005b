// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/orthogonal.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/base/parallel.hpp"
#include "bathyal/estimation/gram.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kGroupsAtOnce = 16;

/// Makes all of `groups` orthogonal to `basis`, with one product for all of them.
void project_out(std::vector<Eigen::MatrixXd>& groups, const Eigen::MatrixXd& basis,
                 int num_threads) {
  Eigen::MatrixXd all = concatenate_columns(groups);
  add_product(basis, -inner_products(basis, all, num_threads), all, num_threads);
  Index first = 0;
  for (Eigen::MatrixXd& group : groups) {
    group = all.middleCols(first, group.cols());
    first += group.cols();
  }
}

}  // namespace

void append(Eigen::MatrixXd& columns, const Eigen::MatrixXd& more) {
  columns.conservativeResize(Eigen::NoChange, columns.cols() + more.cols());
  columns.rightCols(more.cols()) = more;
}

Eigen::MatrixXd concatenate_columns(const std::vector<Eigen::MatrixXd>& columns) {
  Index wide = 0;
  for (const Eigen::MatrixXd& group : columns) wide += group.cols();
  Eigen::MatrixXd out(columns.empty() ? 0 : columns.front().rows(), wide);
  wide = 0;
  for (const Eigen::MatrixXd& group : columns) {
    out.middleCols(wide, group.cols()) = group;
    wide += group.cols();
  }
  return out;
}

void normalize_columns(Eigen::MatrixXd& columns) {
  for (Index c = 0; c < columns.cols(); ++c) {
    const double length = columns.col(c).norm();
    if (length > 0.0) columns.col(c) /= length;
  }
}

Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance) {
  normalize_columns(columns);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(tolerance);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

double least_length(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  // In standard deviations of the noise, of all rows together.
  constexpr double kDetectable = 2.0;
  const double longest = columns.cols() > 0 ? columns.colwise().norm().maxCoeff() : 0.0;
  return std::max(kDetectable, kCollinearityTolerance * longest);
}

std::vector<ProjectedColumns> projected_columns(const Eigen::MatrixXd& basis,
                                                std::vector<Eigen::MatrixXd> groups,
                                                int num_threads) {
  std::vector<ProjectedColumns> out(groups.size());
  std::vector<double> least(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) least[g] = least_length(groups[g]);
  const auto for_each = [&](const auto& body) {
    parallel_for(groups.size(), kGroupsAtOnce, num_threads,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t g = begin; g < end; ++g) body(g);
                 });
  };
  const int inside = groups.size() == 1 ? num_threads : 1;
  project_out(groups, basis, num_threads);
  for_each([&](std::size_t g) {
    if (groups[g].cols() == 0) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inner_products(groups[g], inside));
    const Eigen::VectorXd& squares = eigen.eigenvalues();
    Index none = 0;
    while (none < squares.size() && !(squares[none] > least[g] * least[g])) ++none;
    const Index kept = squares.size() - none;
    out[g].length = squares.tail(kept).cwiseSqrt();
    groups[g] = product(
        groups[g], eigen.eigenvectors().rightCols(kept) * out[g].length.cwiseInverse().asDiagonal(),
        inside);
  });
  // Removes the remaining rounding errors by a symmetric correction, which rotates nothing.
  project_out(groups, basis, num_threads);
  for_each([&](std::size_t g) {
    if (groups[g].cols() > 0) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> skew(inner_products(groups[g], inside));
      groups[g] = product(groups[g], skew.operatorInverseSqrt(), inside);
    }
    out[g].columns = std::move(groups[g]);
  });
  return out;
}

}  // namespace bathyal
