// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/kinematics.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "bathyal/arm/forward_program.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/simd.hpp"

namespace bathyal {
namespace {

using arm::ForwardKernel;
using arm::Program;

constexpr std::size_t kGrain = 512;  ///< poses of one task; a multiple of every number of lanes

ForwardKernel kernel() {
#if defined(BATHYAL_X86_KERNELS)
  switch (simd_level()) {
    case SimdLevel::kAvx512:
      return arm::avx512_forward;
    case SimdLevel::kAvx2:
      return arm::avx2_forward;
    case SimdLevel::kBaseline:
      break;
  }
#endif
  return arm::baseline_forward;
}

/// What is wanted of a batch; null is not.
struct Wanted {
  double* poses = nullptr;
  double* links = nullptr;
  double* jacobians = nullptr;
  TipFrame frame = TipFrame::kWorld;
};

void run(const Arm& arm, JointView q, const Wanted& wanted, int num_threads) {
  const Program program(arm);
  const ForwardKernel forward = kernel();
  parallel_for(static_cast<std::size_t>(q.rows()), kGrain, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 std::vector<double> scratch(scratch_size(program.view));
                 forward(program.view,
                         {q.data(), begin, end, wanted.poses, wanted.links, wanted.jacobians,
                          wanted.frame == TipFrame::kTool, scratch.data()});
               });
}

std::vector<double> numbers(Index rows, std::size_t width) {
  return std::vector<double>(static_cast<std::size_t>(rows) * width);
}

}  // namespace

void check_joint_values(const Arm& arm, JointView q, std::string_view name) {
  if (q.cols() != arm.size()) {
    throw_argument(name,
                   std::to_string(arm.size()) + " values a pose, one for each coordinate of " +
                       (arm.name().empty() ? "the arm" : arm.name()),
                   std::to_string(q.cols()));
  }
  for (Index i = 0; i < q.rows(); ++i) {
    for (Index j = 0; j < q.cols(); ++j) {
      if (!std::isfinite(q(i, j))) {
        throw_argument(name, "finite numbers", to_text(q(i, j)) + " in row " + std::to_string(i));
      }
    }
  }
}

std::vector<double> forward(const Arm& arm, JointView q, int num_threads) {
  check_joint_values(arm, q);
  std::vector<double> poses = numbers(q.rows(), 16);
  run(arm, q, {.poses = poses.data()}, num_threads);
  return poses;
}

std::vector<double> forward_links(const Arm& arm, JointView q, int num_threads) {
  check_joint_values(arm, q);
  std::vector<double> links = numbers(q.rows(), 16 * arm.links().size());
  run(arm, q, {.links = links.data()}, num_threads);
  return links;
}

std::vector<double> jacobian(const Arm& arm, JointView q, TipFrame frame, int num_threads) {
  check_joint_values(arm, q);
  std::vector<double> jacobians = numbers(q.rows(), static_cast<std::size_t>(6 * arm.size()));
  run(arm, q, {.jacobians = jacobians.data(), .frame = frame}, num_threads);
  return jacobians;
}

PosesAndJacobians forward_and_jacobian(const Arm& arm, JointView q, TipFrame frame,
                                       int num_threads) {
  PosesAndJacobians result;
  compute_forward_and_jacobian(arm, q, result, frame, num_threads);
  return result;
}

void compute_forward_and_jacobian(const Arm& arm, JointView q, PosesAndJacobians& result,
                                  TipFrame frame, int num_threads) {
  check_joint_values(arm, q);
  const std::size_t rows = static_cast<std::size_t>(q.rows());
  result.poses.resize(16 * rows);
  result.jacobians.resize(6 * rows * static_cast<std::size_t>(arm.size()));
  run(arm, q, {.poses = result.poses.data(), .jacobians = result.jacobians.data(), .frame = frame},
      num_threads);
}

std::vector<bool> within_limits(const Arm& arm, JointView q, double tolerance) {
  check_joint_values(arm, q);
  std::vector<bool> within(static_cast<std::size_t>(q.rows()));
  for (Index i = 0; i < q.rows(); ++i) {
    const auto pose = q.row(i).transpose().array();
    within[static_cast<std::size_t>(i)] = (pose >= arm.lower().array() - tolerance).all() &&
                                          (pose <= arm.upper().array() + tolerance).all();
  }
  return within;
}

void check_joint_angles(const Arm& arm, JointView q, std::string_view name) {
  check_joint_values(arm, q, name);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (const Joint& joint : arm.joints()) {
    if (joint.type != JointType::kRevolute) continue;
    const Index j = joint.coordinate;
    for (Index i = 0; i < q.rows(); ++i) {
      const double value = q(i, j);
      const bool beyond = value < arm.lower()[j] || value > arm.upper()[j] ||
                          !std::isfinite(arm.upper()[j] - arm.lower()[j]);
      if (beyond && std::abs(value) > 2.0 * kTurn) {
        throw_argument(name,
                       "radians within the limits of " +
                           (joint.name.empty() ? "joint " + std::to_string(j) : joint.name) +
                           " (degrees are given as " + std::string(name) + "_deg)",
                       to_text(value) + " in row " + std::to_string(i));
      }
    }
  }
}

std::vector<double> manipulability(const Arm& arm, JointView q, Manipulability kind,
                                   JacobianPart part, int num_threads) {
  const std::vector<double> jacobians = jacobian(arm, q, TipFrame::kWorld, num_threads);
  const Index width = 6 * arm.size();
  const Index first = part == JacobianPart::kAngular ? 3 : 0;
  const Index rows = part == JacobianPart::kAll ? 6 : 3;
  std::vector<double> result(static_cast<std::size_t>(q.rows()));
  parallel_for(result.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const JointView matrix(jacobians.data() + static_cast<Index>(i) * width, 6, arm.size());
      const Eigen::MatrixXd counted = matrix.middleRows(first, rows);
      const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(counted).singularValues();
      const double smallest = values[values.size() - 1];
      result[i] = kind == Manipulability::kYoshikawa  ? values.prod()
                  : kind == Manipulability::kSmallest ? smallest
                  : values[0] > 0.0                   ? smallest / values[0]
                                                      : 0.0;
    }
  });
  return result;
}

}  // namespace bathyal
