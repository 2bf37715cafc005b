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

void check_size(std::string_view name, std::span<double> memory, Index rows, std::size_t width) {
  const std::size_t expected = static_cast<std::size_t>(rows) * width;
  if (!memory.empty() && memory.size() != expected) {
    throw_argument(name, "room for " + std::to_string(expected) + " numbers",
                   std::to_string(memory.size()));
  }
}

double* data_of(std::span<double> memory) { return memory.empty() ? nullptr : memory.data(); }

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
  std::vector<double> poses = numbers(q.rows(), 16);
  compute_kinematics(arm, q, {.poses = poses}, num_threads);
  return poses;
}

std::vector<double> forward_links(const Arm& arm, JointView q, int num_threads) {
  std::vector<double> links = numbers(q.rows(), 16 * arm.links().size());
  compute_kinematics(arm, q, {.links = links}, num_threads);
  return links;
}

std::vector<double> jacobian(const Arm& arm, JointView q, TipFrame frame, int num_threads) {
  std::vector<double> jacobians = numbers(q.rows(), static_cast<std::size_t>(6 * arm.size()));
  compute_kinematics(arm, q, {.jacobians = jacobians, .frame = frame}, num_threads);
  return jacobians;
}

PosesAndJacobians forward_and_jacobian(const Arm& arm, JointView q, TipFrame frame,
                                       int num_threads) {
  PosesAndJacobians result{numbers(q.rows(), 16),
                           numbers(q.rows(), static_cast<std::size_t>(6 * arm.size()))};
  compute_kinematics(arm, q, {.poses = result.poses, .jacobians = result.jacobians, .frame = frame},
                     num_threads);
  return result;
}

void compute_kinematics(const Arm& arm, JointView q, const KinematicsOutput& output,
                        int num_threads) {
  check_joint_values(arm, q);
  check_size("poses", output.poses, q.rows(), 16);
  check_size("links", output.links, q.rows(), 16 * arm.links().size());
  check_size("jacobians", output.jacobians, q.rows(), static_cast<std::size_t>(6 * arm.size()));
  const Program program(arm);
  const ForwardKernel forward = kernel();
  parallel_for(static_cast<std::size_t>(q.rows()), kGrain, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 std::vector<double> scratch(scratch_size(program.view));
                 forward(program.view, {q.data(), begin, end, data_of(output.poses),
                                        data_of(output.links), data_of(output.jacobians),
                                        output.frame == TipFrame::kTool, scratch.data()});
               });
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
