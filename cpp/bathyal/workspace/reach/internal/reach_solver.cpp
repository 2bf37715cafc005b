// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bathyal::workspace {
namespace {

constexpr double kTolerance = 1e-4;  ///< of what a last step leaves, to first order [m]
constexpr double kLastStep = 0.02;   ///< of a coordinate [rad], [m]
constexpr int kIterations = 25;
constexpr int kPatience = 2;          ///< steps within which the error must fall …
constexpr double kProgress = 0.6;     ///< … to this share
constexpr double kDamping = 0.3;      ///< over half the squared error, as of inverse()
constexpr double kFloor = 1e-9;       ///< of the damping, over the trace of J Jᵀ
constexpr double kLongestStep = 0.6;  ///< of a coordinate [rad], [m]
constexpr std::size_t kRows = 5;

/// `Size` numbers in place, or on the heap when it is below 0.
template <class Value, int Size>
struct Numbers : std::array<Value, static_cast<std::size_t>(Size)> {
  explicit Numbers(std::size_t /*size*/) {}
};
template <class Value, int Size>
requires(Size < 0) struct Numbers<Value, Size> : std::vector<Value> {
  explicit Numbers(std::size_t size) : std::vector<Value>(size) {}
};

enum class Progress { kMoved, kReached };

/// One target's step: J (5 or 3 rows) and what is missing. N: coordinates, or -1 for any number.
template <int N>
class Stepper {
 public:
  explicit Stepper(const ReachArm& arm)
      : arm_(arm), size_(arm.size()), J_(kRows * size_), step_(size_), locked_(size_) {}

  /// Reads pose and Jacobian.
  void look(const ReachTarget& target, const double* pose, const double* jacobian) {
    const Vec3 tip(pose[3], pose[7], pose[11]);
    z_ = Vec3(pose[2], pose[6], pose[10]);
    const Vec3& z = z_;
    const Vec3 missing = target.middle - tip;
    const bool directed = target.direction.squaredNorm() > 0.0;
    m_ = directed ? 5 : 3;
    const std::size_t n = size();
    for (std::size_t r = 0; r < 3; ++r) {
      e_[r] = missing[static_cast<Index>(r)];
      std::copy_n(jacobian + r * n, n, &J_[r * n]);
    }
    if (directed) {
      const Vec3 cross = z.cross(target.direction);
      const double sine = cross.norm();
      const double angle = std::atan2(sine, z.dot(target.direction));
      const Vec3 side = z.unitOrthogonal();
      const Vec3 other = z.cross(side);
      const Vec3 turn = sine > 1e-12 ? Vec3(cross * (angle / sine))
                                     : Vec3(angle > 1.0 ? Vec3(side * angle) : cross);
      const double* w = jacobian + 3 * n;
      for (std::size_t j = 0; j < size(); ++j) {
        const Vec3 column(w[j], w[n + j], w[2 * n + j]);
        J_[3 * n + j] = arm_.length * side.dot(column);
        J_[4 * n + j] = arm_.length * other.dot(column);
      }
      e_[3] = arm_.length * side.dot(turn);
      e_[4] = arm_.length * other.dot(turn);
    }
    cost_ = 0.0;
    for (std::size_t r = 0; r < m_; ++r) cost_ += 0.5 * e_[r] * e_[r];
  }

  double cost() const { return cost_; }

  /// Moves q; joints that the step would take beyond their limits go there and no further, and the
  /// others make up for it.
  Progress move(double* q) {
    std::fill(locked_.begin(), locked_.end(), false);
    double longest = 0.0;
    for (std::size_t pass = 0; pass < 3; ++pass) {
      solve();
      bool again = false;
      for (std::size_t j = 0; j < size(); ++j) {
        if (locked_[j]) continue;
        const double to = std::clamp(q[j] + step_[j], arm_.lower[j], arm_.upper[j]);
        if (to == q[j] + step_[j]) continue;
        // What the joint still does is taken from what is missing.
        const double done = to - q[j];
        longest = std::max(longest, std::abs(done));
        for (std::size_t r = 0; r < m_; ++r) e_[r] -= J_[r * size() + j] * done;
        q[j] = to;
        locked_[j] = true;
        again = true;
      }
      if (!again) break;
    }
    double rest = 0.0;
    for (std::size_t r = 0; r < m_; ++r) rest += left(r) * left(r);
    for (std::size_t j = 0; j < size(); ++j) {
      if (!locked_[j]) longest = std::max(longest, std::abs(step_[j]));
    }
    const double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
    for (std::size_t j = 0; j < size(); ++j) {
      if (!locked_[j]) q[j] = std::clamp(q[j] + share * step_[j], arm_.lower[j], arm_.upper[j]);
    }
    const bool arrives = longest <= kLastStep && rest <= kTolerance * kTolerance;
    return arrives ? Progress::kReached : Progress::kMoved;
  }

  const Vec3& z_axis() const { return z_; }

 private:
  std::size_t size() const {
    if constexpr (N > 0) return N;
    return size_;
  }

  /// Of what is missing in row r, when the step has been made.
  double left(std::size_t r) const {
    double sum = e_[r];
    for (std::size_t j = 0; j < size(); ++j) sum -= J_[r * size() + j] * step_[j];
    return sum;
  }

  /// step = Jᵀ (J Jᵀ + damping)⁻¹ e over the joints that are not locked.
  void solve() {
    const std::size_t n = size();
    double A[kRows][kRows];
    double trace = 0.0;
    for (std::size_t a = 0; a < m_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = 0.0;
        for (std::size_t j = 0; j < size(); ++j) {
          if (!locked_[j]) sum += J_[a * n + j] * J_[b * n + j];
        }
        A[a][b] = sum;
      }
      trace += A[a][a];
    }
    const double damping = kDamping * cost_ + kFloor * trace + 1e-300;
    double x[kRows];
    for (std::size_t a = 0; a < m_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = A[a][b] + (a == b ? damping : 0.0);
        for (std::size_t k = 0; k < b; ++k) sum -= A[a][k] * A[b][k];
        A[a][b] = a == b ? 1.0 / std::sqrt(std::max(sum, 1e-300)) : sum * A[b][b];
      }
      double sum = e_[a];
      for (std::size_t k = 0; k < a; ++k) sum -= A[a][k] * x[k];
      x[a] = sum * A[a][a];
    }
    for (std::size_t a = m_; a-- > 0;) {
      double sum = x[a];
      for (std::size_t k = a + 1; k < m_; ++k) sum -= A[k][a] * x[k];
      x[a] = sum * A[a][a];
    }
    for (std::size_t j = 0; j < size(); ++j) {
      double sum = 0.0;
      for (std::size_t a = 0; a < m_; ++a) sum += J_[a * n + j] * x[a];
      step_[j] = locked_[j] ? 0.0 : sum;
    }
  }

  const ReachArm& arm_;
  std::size_t size_, m_ = 0;
  Numbers<double, (N > 0 ? static_cast<int>(kRows) * N : -1)> J_;
  Numbers<double, N> step_;
  Numbers<bool, N> locked_;
  Vec3 z_ = Vec3::Zero();
  double e_[kRows] = {};
  double cost_ = 0.0;
};

template <int N>
ReachSolutions solve(const ReachArm& arm, std::span<const ReachTarget> targets, JointMatrix& q) {
  const std::size_t n = arm.size();
  ReachSolutions result;
  result.reached.assign(targets.size(), 0);
  result.z_axis.assign(targets.size(), Vec3::Zero());
  std::vector<std::size_t> active(targets.size());
  for (std::size_t i = 0; i < active.size(); ++i) active[i] = i;
  std::vector<double> marked(targets.size(), std::numeric_limits<double>::infinity());
  JointMatrix rows;
  std::vector<double> poses, jacobians;
  Stepper<N> stepper(arm);
  for (int iteration = 0; iteration < kIterations && !active.empty(); ++iteration) {
    rows.resize(static_cast<Index>(active.size()), static_cast<Index>(n));
    for (std::size_t k = 0; k < active.size(); ++k) {
      rows.row(static_cast<Index>(k)) = q.row(static_cast<Index>(active[k]));
    }
    poses.resize(active.size() * 16);
    jacobians.resize(active.size() * 6 * n);
    compute_kinematics(arm.arm, view_of(rows), {.poses = poses, .jacobians = jacobians}, 1);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < active.size(); ++k) {
      const std::size_t i = active[k];
      stepper.look(targets[i], poses.data() + 16 * k, jacobians.data() + 6 * n * k);
      if (iteration % kPatience == 0) {
        if (stepper.cost() > kProgress * kProgress * marked[i]) continue;
        marked[i] = stepper.cost();
      }
      if (stepper.move(q.row(static_cast<Index>(i)).data()) == Progress::kMoved) {
        active[kept++] = i;
      } else {
        result.reached[i] = 1;
        result.z_axis[i] = stepper.z_axis();
      }
    }
    active.resize(kept);
  }
  return result;
}

}  // namespace

ReachSolutions solve_targets(const ReachArm& arm, std::span<const ReachTarget> targets,
                             JointMatrix& q) {
  switch (arm.size()) {
    case 3:
      return solve<3>(arm, targets, q);
    case 4:
      return solve<4>(arm, targets, q);
    case 5:
      return solve<5>(arm, targets, q);
    case 6:
      return solve<6>(arm, targets, q);
    case 7:
      return solve<7>(arm, targets, q);
    case 8:
      return solve<8>(arm, targets, q);
    default:
      return solve<-1>(arm, targets, q);
  }
}

}  // namespace bathyal::workspace
