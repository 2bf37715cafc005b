// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bathyal::workspace {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kViolation = 1e-11;  // by which a constraint may be missed
constexpr double kDependent = 1e-12;  // squared sine of a normal against those of the active set
constexpr double kNullSpace = 1e-6;   // a singular value, over the largest, that counts as none
constexpr int kStepsPerConstraint = 10;

/// Constraints as normal · x ≥ least, one a row.
struct Constraints {
  MatrixXd normals;
  VectorXd least;
};

Constraints stacked(const LinearBounds& bounds) {
  const Eigen::Index n = bounds.lower.size(), m = bounds.rows.rows();
  Constraints all{MatrixXd::Zero(2 * n + m, n), VectorXd(2 * n + m)};
  all.normals.topRows(n).setIdentity();
  all.normals.middleRows(n, n).diagonal().setConstant(-1.0);
  if (m > 0) all.normals.bottomRows(m) = bounds.rows;
  all.least << bounds.lower, -bounds.upper, bounds.least;
  return all;
}

class DualActiveSet {
 public:
  DualActiveSet(const MatrixXd& hessian, const VectorXd& gradient, const Constraints& constraints)
      : constraints_(constraints), factor_(hessian), x_(factor_.solve(gradient)) {}

  BoundedAnswer solve() {
    const auto most = kStepsPerConstraint * (constraints_.least.size() + 1);
    for (Eigen::Index step = 0; step < most; ++step) {
      const int worst = most_violated();
      if (worst < 0) return {true, x_, active_};
      if (!take_in(worst)) break;
      remove_drift();
    }
    return {false, x_, active_};
  }

 private:
  double slack(int i) const { return constraints_.normals.row(i).dot(x_) - constraints_.least[i]; }

  int most_violated() const {
    int worst = -1;
    double least = -kViolation;
    for (int i = 0; i < constraints_.least.size(); ++i) {
      if (std::ranges::find(active_, i) != active_.end()) continue;
      const double here = slack(i);
      if (here < least) least = here, worst = i;
    }
    return worst;
  }

  /// Moves x until constraint `p` holds, dropping those whose multiplier comes to zero on the way;
  /// false where no x fulfils it together with the active ones.
  bool take_in(int p) {
    double multiplier = 0.0;
    for (int step = 0; step <= constraints_.least.size(); ++step) {
      // In coordinates where the Hessian is the identity: the normal without what the active
      // normals span, and how much of each of those it takes.
      const VectorXd normal = factor_.matrixL().solve(constraints_.normals.row(p).transpose());
      VectorXd shares(std::ssize(active_)), rest = normal;
      if (!active_.empty()) {
        MatrixXd spanned(normal.size(), std::ssize(active_));
        for (Eigen::Index k = 0; k < spanned.cols(); ++k) {
          spanned.col(k) = factor_.matrixL().solve(
              constraints_.normals.row(active_[static_cast<std::size_t>(k)]).transpose());
        }
        shares = spanned.householderQr().solve(normal);
        rest -= spanned * shares;
      }
      const bool dependent = rest.squaredNorm() <= kDependent * normal.squaredNorm();
      const double full = dependent ? kInfinity : -slack(p) / rest.squaredNorm();
      double until = kInfinity;
      std::size_t leaving = 0;
      for (std::size_t k = 0; k < active_.size(); ++k) {
        const double share = shares[static_cast<Eigen::Index>(k)];
        if (share > 0.0 && multipliers_[k] / share < until) {
          until = multipliers_[k] / share;
          leaving = k;
        }
      }
      const double length = std::min(full, until);
      if (length == kInfinity) return false;
      if (!dependent) x_ += length * factor_.matrixU().solve(rest);
      for (std::size_t k = 0; k < active_.size(); ++k) {
        multipliers_[k] -= length * shares[static_cast<Eigen::Index>(k)];
      }
      multiplier += length;
      if (full <= until) {
        active_.push_back(p);
        multipliers_.push_back(multiplier);
        return true;
      }
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(leaving));
      multipliers_.erase(multipliers_.begin() + static_cast<std::ptrdiff_t>(leaving));
    }
    return false;
  }

  /// With little damping the Hessian is nearly singular and x moves far: puts it back onto the
  /// active constraints by the shortest way.
  void remove_drift() {
    const auto count = std::ssize(active_);
    MatrixXd normals(count, x_.size());
    VectorXd missing(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const int i = active_[static_cast<std::size_t>(k)];
      normals.row(k) = constraints_.normals.row(i);
      missing[k] = -slack(i);
    }
    x_ += normals.transpose() * (normals * normals.transpose()).ldlt().solve(missing);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Constraints& constraints_;
  Eigen::LLT<MatrixXd> factor_;
  VectorXd x_;
  std::vector<int> active_;
  std::vector<double> multipliers_;
};

BoundedAnswer minimize(const MatrixXd& a, const VectorXd& b, double damping,
                       const Constraints& constraints) {
  MatrixXd hessian = a.transpose() * a;
  hessian.diagonal().array() += damping;
  return DualActiveSet(hessian, a.transpose() * b, constraints).solve();
}

/// An orthonormal basis of what `a` maps to nothing.
MatrixXd null_space(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullV);
  const VectorXd& values = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < values.size() && values[rank] > kNullSpace * std::max(values[0], 1e-9)) ++rank;
  return svd.matrixV().rightCols(a.cols() - rank);
}

}  // namespace

BoundedAnswer minimize(const MatrixXd& a, const VectorXd& b, double damping,
                       const LinearBounds& bounds) {
  return minimize(a, b, damping, stacked(bounds));
}

BoundedAnswer prioritized(std::span<const Task> tasks, LinearBounds bounds) {
  const Eigen::Index n = bounds.lower.size();
  Constraints constraints = stacked(bounds);
  BoundedAnswer answer{true, VectorXd::Zero(n), {}};
  MatrixXd basis = MatrixXd::Identity(n, n);
  for (std::size_t i = 0; i < tasks.size() && basis.cols() > 0; ++i) {
    const MatrixXd reduced = tasks[i].jacobian * basis;
    const VectorXd missing = tasks[i].wanted - tasks[i].jacobian * answer.x;
    const auto within = [&] {
      VectorXd least = constraints.least - constraints.normals * answer.x;
      // What was found so far is within the bounds, but for rounding.
      if (i > 0) least = least.cwiseMin(0.0);
      return Constraints{constraints.normals * basis, std::move(least)};
    };
    BoundedAnswer part = minimize(reduced, missing, tasks[i].damping, within());
    if (i == 0) {
      if (!part.feasible) {
        constraints.least.tail(bounds.rows.rows()) = bounds.least.cwiseMin(0.0);
        part = minimize(reduced, missing, tasks[i].damping, within());
        answer.feasible = false;
      }
      answer.active = part.active;
    }
    if (!part.x.allFinite()) break;
    // A later task that finds no way within rounding leaves the step as it is.
    if (i == 0 || part.feasible) answer.x += basis * part.x;
    basis *= null_space(reduced);
  }
  return answer;
}

}  // namespace bathyal::workspace
