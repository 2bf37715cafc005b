// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/inverse.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "bathyal/arm/forward_program.hpp"
#include "bathyal/arm/internal/inverse_search.hpp"
#include "bathyal/arm/internal/inverse_stepping.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"

namespace bathyal {
namespace {

using arm::InverseRows;
using arm::PlainPose;

constexpr std::size_t kGrain = 16;  ///< targets of one task

void check_count(std::string_view name, int value, int least) {
  constexpr int kMost = 1'000'000;  // of one target: seconds
  check_range(name, value, least, kMost);
}

std::string in_row(std::size_t row) { return " in row " + std::to_string(row); }

/// Row-major (N, 4, 4) to plain poses; each must be rigid.
std::vector<PlainPose> plain_targets(std::span<const double> targets) {
  std::vector<PlainPose> result(targets.size() / 16);
  for (std::size_t row = 0; row < result.size(); ++row) {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(targets.data() +
                                                                                16 * row);
    Pose pose;
    pose.matrix() = matrix;
    check_rigid("poses" + in_row(row), pose);
    result[row] = arm::plain(pose);
  }
  return result;
}

void check_starts(const Arm& arm, JointView starts, std::size_t targets) {
  if (starts.rows() == 0) return;
  check_joint_values(arm, starts, "start");
  if (starts.rows() != 1 && static_cast<std::size_t>(starts.rows()) != targets) {
    throw_argument("start", "one, or " + std::to_string(targets) + ", one a pose",
                   std::to_string(starts.rows()));
  }
  for (Index i = 0; i < starts.rows(); ++i) {
    for (Index j = 0; j < starts.cols(); ++j) {
      check_range("start" + in_row(static_cast<std::size_t>(i)), starts(i, j), arm.lower()[j],
                  arm.upper()[j]);
    }
  }
}

InverseResult empty_result(std::size_t rows, Index size) {
  InverseResult result;
  result.q.setZero(static_cast<Index>(rows), size);
  result.status.resize(rows);
  result.error.resize(rows);
  result.position_error.resize(rows);
  result.angle_error.resize(rows);
  result.iterations.resize(rows);
  result.starts.resize(rows);
  return result;
}

}  // namespace

std::string_view to_text(InverseStatus status) {
  switch (status) {
    case InverseStatus::kReached:
      return "reached";
    case InverseStatus::kLimit:
      return "limit";
    case InverseStatus::kSingular:
      return "singular";
    case InverseStatus::kOutOfReach:
      return "out_of_reach";
  }
  return "unknown";
}

void InverseOptions::check() const {
  if (!(axis.norm() > 0.0) || !axis.allFinite()) {
    throw_argument("axis", "a finite vector other than zero", "zero, nan or inf");
  }
  if (position_tolerance) check_positive("position_tolerance", *position_tolerance);
  if (angle_tolerance) check_positive("angle_tolerance", *angle_tolerance);
  check_count("max_iterations", max_iterations, 1);
  check_count("max_starts", max_starts, 1);
  check_count("candidates", candidates, 1);
  if (centering_steps) check_count("centering_steps", *centering_steps, 0);
  check_count("steps", steps, 1);
}

InverseResult inverse(const Arm& arm, std::span<const double> targets, JointView starts,
                      const InverseOptions& options) {
  options.check();
  const std::vector<PlainPose> poses = plain_targets(targets);
  check_starts(arm, starts, poses.size());
  InverseResult result = empty_result(poses.size(), arm.size());
  const std::unique_ptr<InverseRows> rows = options.method == InverseMethod::kPseudoInverse
                                                ? arm::make_stepping(arm, options)
                                                : arm::make_search(arm, options);
  const std::size_t start_step =
      starts.rows() > 1 ? static_cast<std::size_t>(arm.size()) : std::size_t{0};
  parallel_for(poses.size(), kGrain, options.num_threads, [&](std::size_t begin, std::size_t end) {
    rows->solve(poses, begin, end, starts.rows() > 0 ? starts.data() : nullptr, start_step, result);
  });
  return result;
}

}  // namespace bathyal
