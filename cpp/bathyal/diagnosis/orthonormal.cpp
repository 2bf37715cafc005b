// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/orthonormal.hpp"

namespace bathyal {
namespace {

void scale_to_length_1(Eigen::MatrixXd& columns) {
  for (Index c = 0; c < columns.cols(); ++c) {
    const double length = columns.col(c).norm();
    if (length > 0.0) columns.col(c) /= length;
  }
}

/// The directions of `columns` that are longer than `least`. From the square of the columns, twice:
/// what the first time leaves askew the second sets right.
Eigen::MatrixXd directions(const Eigen::MatrixXd& columns, double least) {
  if (columns.cols() == 0) return columns;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(columns.transpose() * columns);
  const Eigen::VectorXd& squares = eigen.eigenvalues();
  Index none = 0;
  while (none < squares.size() && !(squares[none] > least * least)) ++none;
  const Index kept = squares.size() - none;
  Eigen::MatrixXd out = columns * (eigen.eigenvectors().rightCols(kept) *
                                   squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
  return out;
}

}  // namespace

Eigen::MatrixXd orthonormal(Eigen::MatrixXd columns, double tolerance) {
  scale_to_length_1(columns);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(tolerance);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::MatrixXd orthonormal_beside(const Eigen::MatrixXd& basis, Eigen::MatrixXd columns) {
  scale_to_length_1(columns);
  columns -= basis * (basis.transpose() * columns);
  Eigen::MatrixXd out = directions(columns, kSwallowed);
  // What rounding has left of the basis and of one another.
  out -= basis * (basis.transpose() * out);
  return directions(out, 0.5);
}

}  // namespace bathyal
