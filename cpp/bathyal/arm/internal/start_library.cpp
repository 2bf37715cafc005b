// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/internal/start_library.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/random.hpp"

namespace bathyal::arm {
namespace {

constexpr Index kCount = 256;

/// The range a coordinate is drawn from: its limits, but of a turning one no more than a turn and
/// of a sliding one without limits no more than the arm's length.
double half_width(const InverseProblem& problem, std::size_t j) {
  const double half = 0.5 * (problem.upper[j] - problem.lower[j]);
  if (problem.turns[j] != 0) return std::min(half, std::numbers::pi);
  return std::isfinite(half) ? half : 5.0 * problem.task.length;
}

}  // namespace

StartLibrary::StartLibrary(const Arm& arm, const InverseProblem& problem, std::uint64_t seed)
    : problem_(problem), starts_(kCount, arm.size()), limit_scores_(kCount) {
  RandomStream random(seed);
  for (Index i = 0; i < kCount; ++i) {
    for (std::size_t j = 0; j < problem.size(); ++j) {
      const double half = half_width(problem, j);
      const double value = std::clamp(problem.middle[j] + half * random.uniform(-1.0, 1.0),
                                      problem.lower[j], problem.upper[j]);
      starts_(i, static_cast<Index>(j)) = value;
      if (problem.wraps[j] != 0 || !(half > 0.0)) continue;
      const double share = (value - problem.middle[j]) / half;
      limit_scores_[i] += std::pow(problem.task.length * share * share, 2);
    }
  }
  poses_ = forward(arm, JointView(starts_.data(), kCount, arm.size()), 1);
}

void StartLibrary::score(const PlainPose& target, std::vector<double>& scores) const {
  scores = limit_scores_;
  const double weight = problem_.task.kind == InverseTask::kPosition
                            ? 0.0
                            : problem_.task.length * problem_.task.length;
  const double* origin = problem_.program.view.world_from_first.translation;
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const double* pose = poses_.data() + 16 * k;
    double squared = 0.0, trace = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double gap = pose[4 * i + 3] - origin[i] - target.translation[i];
      squared += gap * gap;
      for (int j = 0; j < 3; ++j) trace += pose[4 * i + j] * target.rotation[3 * i + j];
    }
    scores[k] += squared + weight * (3.0 - trace);  // 3 − tr is the squared angle, when small
  }
}

}  // namespace bathyal::arm
