// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/orthonormal.hpp"

#include <algorithm>
#include <utility>

namespace bathyal {

void append(Eigen::MatrixXd& columns, const Eigen::MatrixXd& more) {
  columns.conservativeResize(Eigen::NoChange, columns.cols() + more.cols());
  columns.rightCols(more.cols()) = more;
}

Eigen::MatrixXd side_by_side(const std::vector<Eigen::MatrixXd>& columns) {
  Index wide = 0;
  for (const Eigen::MatrixXd& some : columns) wide += some.cols();
  Eigen::MatrixXd out(columns.empty() ? 0 : columns.front().rows(), wide);
  wide = 0;
  for (const Eigen::MatrixXd& some : columns) {
    out.middleCols(wide, some.cols()) = some;
    wide += some.cols();
  }
  return out;
}

void scale_to_length_1(Eigen::MatrixXd& columns) {
  for (Index c = 0; c < columns.cols(); ++c) {
    const double length = columns.col(c).norm();
    if (length > 0.0) columns.col(c) /= length;
  }
}

Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance) {
  scale_to_length_1(columns);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(tolerance);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

double least_length(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  // In standard deviations of the noise, of all rows together.
  constexpr double kLeastSeen = 2.0;
  const double longest = columns.cols() > 0 ? columns.colwise().norm().maxCoeff() : 0.0;
  return std::max(kLeastSeen, kSwallowed * longest);
}

Beside orthonormal_beside(const Eigen::MatrixXd& basis, Eigen::MatrixXd columns) {
  if (columns.cols() == 0) return {std::move(columns), {}};
  const double least = least_length(columns);
  columns -= basis * (basis.transpose() * columns);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(columns.transpose() * columns);
  const Eigen::VectorXd& squares = eigen.eigenvalues();
  Index none = 0;
  while (none < squares.size() && !(squares[none] > least * least)) ++none;
  const Index kept = squares.size() - none;
  Beside out;
  out.length = squares.tail(kept).cwiseSqrt();
  out.columns =
      columns * (eigen.eigenvectors().rightCols(kept) * out.length.cwiseInverse().asDiagonal());
  // What rounding has left of the basis and of one another; nothing is turned by that.
  if (kept > 0) {
    out.columns -= basis * (basis.transpose() * out.columns);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> skew(out.columns.transpose() *
                                                              out.columns);
    out.columns *= skew.operatorInverseSqrt();
  }
  return out;
}

}  // namespace bathyal
