// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/navigation_smoother.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/navigation/internal/filter_steps.hpp"

namespace bathyal {
namespace {

/// What the readings after a moment say of the errors at it: the smoothed error is −P λ, and its
/// covariance P − P Λ P.
struct Adjoint {
  NavigationVector lambda = NavigationVector::Zero();
  NavigationMatrix spread = NavigationMatrix::Zero();
};

void cross_correction(Adjoint& adjoint, const Correction& c) {
  NavigationMatrix kept = NavigationMatrix::Identity();
  kept.noalias() -= c.gain * c.slope;
  adjoint.lambda =
      (kept.transpose() * adjoint.lambda - c.slope.transpose() * (c.inverse * c.innovation)).eval();
  const NavigationMatrix half = kept.transpose() * adjoint.spread;
  adjoint.spread.noalias() = half * kept;
  adjoint.spread += c.slope.transpose() * c.inverse * c.slope;
}

/// λ ← Fᵀ λ, Λ ← Fᵀ Λ F
void cross_transition(Adjoint& adjoint, const Transition& step) {
  NavigationMatrix f = NavigationMatrix::Identity();
  f.topRows<Transition::kTop>() = step.top;
  f(kCurrent, kCurrent) = f(kCurrent + 1, kCurrent + 1) = step.current_kept;
  adjoint.lambda = (f.transpose() * adjoint.lambda).eval();
  const NavigationMatrix half = f.transpose() * adjoint.spread;
  adjoint.spread.noalias() = half * f;
}

NavigationEstimate smoothed_at(const NavigationEstimate& filtered, const Adjoint& adjoint) {
  NavigationEstimate estimate = filtered;
  const NavigationMatrix& p = filtered.covariance;
  add_error(estimate, -(p * adjoint.lambda));
  const NavigationMatrix half = p * adjoint.spread;
  const NavigationMatrix lost = half * p;
  estimate.covariance -= 0.5 * (lost + lost.transpose());
  return estimate;
}

}  // namespace

NavigationRecord::NavigationRecord(NavigationOptions options) : filter_(std::move(options)) {}
NavigationRecord::~NavigationRecord() = default;
NavigationRecord::NavigationRecord(NavigationRecord&&) noexcept = default;
NavigationRecord& NavigationRecord::operator=(NavigationRecord&&) noexcept = default;

void NavigationRecord::clear() { steps_.clear(); }

std::vector<NavigationEstimate> NavigationRecord::smoothed() const {
  std::vector<NavigationEstimate> rows;
  Adjoint adjoint;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    const NavigationStep& step = steps_[i];
    if (step.is_row) rows.push_back(smoothed_at(step.after, adjoint));
    if (step.is_correction) {
      cross_correction(adjoint, step.correction);
    } else {
      cross_transition(adjoint, step.transition);
    }
  }
  std::reverse(rows.begin(), rows.end());
  return rows;
}

}  // namespace bathyal
