// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "bathyal/arm/inverse_problem.hpp"

// One target from one start: the inner loop of the inverse, in place for up to eight coordinates.

namespace bathyal::arm {

/// `Size` numbers in place, or on the heap when it is below 0.
template <int Size>
struct Buffer : std::array<double, static_cast<std::size_t>(Size)> {
  explicit Buffer(std::size_t /*size*/) {}
};
template <int Size>
requires(Size < 0) struct Buffer<Size> : std::vector<double> {
  explicit Buffer(std::size_t size) : std::vector<double>(size) {}
};

/// N: coordinates, or -1 for any number of them.
template <int N>
class TipSolver {
 public:
  explicit TipSolver(const InverseProblem& problem)
      : problem_(problem),
        size_(problem.size()),
        state_(problem.program.view, problem.task),
        normal_(size_ * size_),
        factor_(size_ * size_),
        gradient_(size_),
        step_(size_),
        free_(size_) {}

  const TipState& state() const { return state_; }

  /// Tip, residual and Jacobian at q.
  void evaluate(const PlainPose& target, const double* q) { state_.evaluate(target, q); }

  bool reached() const {
    return state_.position_error() <= problem_.position_tolerance &&
           state_.angle_error() <= problem_.angle_tolerance;
  }

  /// Levenberg-Marquardt from q downhill until it reaches, stalls or has done its iterations. q
  /// stays within the limits, where it must begin, if `limited`. Returns the iterations; the state
  /// is that of the last q.
  int descend(const PlainPose& target, bool limited, double* q) {
    double marked = std::numeric_limits<double>::infinity();
    for (int iteration = 0;; ++iteration) {
      evaluate(target, q);
      if (reached() || iteration == problem_.max_iterations) return iteration;
      const double cost = state_.cost();
      if (iteration % kPatience == 0) {
        if (cost > kProgress * marked) return iteration;
        marked = cost;
      }
      form_normal_equations();
      lock_at_limits(limited, q);
      const double scale = state_.scale();
      if (!factor(kDamping * cost + kFloor * scale)) return iteration;
      solve(gradient_, step_);
      move(limited, q);
    }
  }

  /// One step of the null space downhill on the distance to the middle of the limits, with the
  /// correction that keeps the tool where it is, from the state at q. Returns the longest part of
  /// it along the null space [rad], [m].
  double center(double* q) {
    form_normal_equations();
    lock_at_limits(true, q);
    if (!factor(kFloor * state_.scale())) return 0.0;
    // The motion of the tool that the step towards the middle would cause is subtracted.
    Buffer<N> pull(size_), seen(size_), leak(size_);
    for (std::size_t j = 0; j < size(); ++j) pull[j] = free_[j] * pull_of(j, q[j]);
    for (std::size_t i = 0; i < size(); ++i) {
      seen[i] = 0.0;
      for (std::size_t j = 0; j < size(); ++j) {
        seen[i] += free_[i] * normal_[std::min(i, j) * size() + std::max(i, j)] * pull[j];
      }
    }
    solve(seen, leak);
    solve(gradient_, step_);
    double longest = 0.0;
    for (std::size_t j = 0; j < size(); ++j) {
      pull[j] -= leak[j];
      longest = std::max(longest, std::abs(pull[j]));
    }
    const double share = longest > kCenteringStep ? kCenteringStep / longest : 1.0;
    for (std::size_t j = 0; j < size(); ++j) step_[j] += share * pull[j];
    move(true, q);
    return share * longest;
  }

 private:
  static constexpr int kPatience = 6;          ///< iterations within which the cost must …
  static constexpr double kProgress = 0.5;     ///< … fall to this share
  static constexpr double kDamping = 0.3;      ///< over the cost
  static constexpr double kFloor = 1e-10;      ///< of the damping, over the trace of JᵀJ
  static constexpr double kLongestStep = 1.0;  ///< of a coordinate [rad], [m]
  static constexpr double kCenteringStep = 0.2;

  std::size_t size() const {
    if constexpr (N > 0) return N;
    return size_;
  }

  double pull_of(std::size_t j, double value) const {
    const double width = problem_.upper[j] - problem_.lower[j];
    return std::isfinite(width) ? 0.5 * (problem_.upper[j] + problem_.lower[j]) - value : 0.0;
  }

  void form_normal_equations() {
    const double* J = state_.jacobian();
    const double* r = state_.residual();
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t row = 0; row < 6; ++row) sum += J[row * n + i] * r[row];
      gradient_[i] = sum;
      double* h = &normal_[i * n];
      for (std::size_t j = i; j < n; ++j) h[j] = J[i] * J[j];
      for (std::size_t row = 1; row < 6; ++row) {
        const double* Jr = J + row * n;
        for (std::size_t j = i; j < n; ++j) h[j] += Jr[i] * Jr[j];
      }
    }
  }

  void lock_at_limits(bool limited, const double* q) {
    for (std::size_t j = 0; j < size(); ++j) {
      const bool out = limited && problem_.wraps[j] == 0 &&
                       ((q[j] <= problem_.lower[j] && gradient_[j] < 0.0) ||
                        (q[j] >= problem_.upper[j] && gradient_[j] > 0.0));
      free_[j] = out ? 0.0 : 1.0;
      if (out) gradient_[j] = 0.0;
    }
  }

  /// Cholesky of JᵀJ + damping over the free joints, L with the inverse of its diagonal.
  bool factor(double damping) {
    const std::size_t n = size();
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = j; i < n; ++i) {
        double sum = free_[i] * free_[j] * normal_[j * n + i];
        if (i == j) sum += free_[j] == 0.0 ? 1.0 : damping;
        for (std::size_t k = 0; k < j; ++k) sum -= factor_[i * n + k] * factor_[j * n + k];
        if (i == j) {
          if (!(sum > 0.0)) return false;
          factor_[j * n + j] = 1.0 / std::sqrt(sum);
        } else {
          factor_[i * n + j] = sum * factor_[j * n + j];
        }
      }
    }
    return true;
  }

  void solve(const Buffer<N>& right, Buffer<N>& x) const {
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i) {
      double sum = right[i];
      for (std::size_t k = 0; k < i; ++k) sum -= factor_[i * n + k] * x[k];
      x[i] = sum * factor_[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
      double sum = x[i];
      for (std::size_t k = i + 1; k < n; ++k) sum -= factor_[k * n + i] * x[k];
      x[i] = sum * factor_[i * n + i];
    }
  }

  void move(bool limited, double* q) const {
    double longest = 0.0;
    for (std::size_t j = 0; j < size(); ++j) longest = std::max(longest, std::abs(step_[j]));
    const double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
    for (std::size_t j = 0; j < size(); ++j) {
      q[j] += share * step_[j];
      if (!limited) continue;
      if (problem_.wraps[j] != 0) {
        if (q[j] > problem_.upper[j]) q[j] -= 2.0 * std::numbers::pi;
        if (q[j] < problem_.lower[j]) q[j] += 2.0 * std::numbers::pi;
      } else {
        q[j] = std::clamp(q[j], problem_.lower[j], problem_.upper[j]);
      }
    }
  }

  const InverseProblem& problem_;
  std::size_t size_;
  TipState state_;
  Buffer<(N > 0 ? N * N : -1)> normal_;  ///< JᵀJ, its upper triangle
  Buffer<(N > 0 ? N * N : -1)> factor_;
  Buffer<N> gradient_;  ///< Jᵀ residual
  Buffer<N> step_;
  Buffer<N> free_;  ///< 1, or 0 for a joint held at its limit
};

}  // namespace bathyal::arm
