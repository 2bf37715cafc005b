// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/start_postures.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/workspace/internal/postures.hpp"

namespace bathyal::workspace {
namespace {

using Eigen::VectorXd;

constexpr double kSame = 0.1;        // postures that differ by less [rad], [m]
constexpr int kStartsEach = 4;       // of the inverse kinematics, from each drawn posture
constexpr int kStartsLooking = 16;   // of the inverse kinematics of next_reachable
constexpr std::int32_t kBlock = 64;  // samples that next_reachable looks at in one go

VectorXd middle_of_limits(const Arm& arm) {
  VectorXd middle = 0.5 * (arm.lower() + arm.upper());
  for (double& value : middle) {
    if (!std::isfinite(value)) value = 0.0;
  }
  return middle;
}

InverseOptions inverse_options(const FollowOptions& options, int starts) {
  InverseOptions inverse;
  inverse.task = options.task;
  inverse.max_starts = starts;
  inverse.seed = options.seed;
  return inverse;
}

void set_halt(InverseStatus status, FollowCut& halt) {
  halt.reason = status == InverseStatus::kOutOfReach ? CutReason::kUnreachable
                : status == InverseStatus::kLimit    ? CutReason::kLimit
                                                     : CutReason::kSingular;
}

}  // namespace

std::vector<VectorXd> start_postures(const Workspace& ws, const PathFollower& follower,
                                     std::int32_t sample, std::span<const double> near,
                                     const FollowOptions& options, FollowCut& halt) {
  const Arm& arm = ws.arm();
  const VectorXd reference = near.empty()
                                 ? middle_of_limits(arm)
                                 : VectorXd(Eigen::Map<const VectorXd>(near.data(), arm.size()));
  const Index drawn = 2 * options.candidates;
  JointMatrix starts(drawn, arm.size());
  RandomStream random(options.seed);
  for (Index i = 0; i < drawn; ++i) starts.row(i) = drawn_posture(arm, random);
  starts.row(0) = reference.cwiseMax(arm.lower()).cwiseMin(arm.upper()).transpose();
  const ReachedPostures found = reached_postures(arm, follower.target(sample).pose, starts,
                                                 inverse_options(options, kStartsEach));
  if (found.q.rows() == 0) {
    set_halt(found.status, halt);
    return {};
  }
  std::vector<VectorXd> postures;
  for (Index i = 0; i < found.q.rows(); ++i) {
    const VectorXd q = found.q.row(i).transpose();
    const bool known = std::ranges::any_of(
        postures, [&](const VectorXd& other) { return (q - other).cwiseAbs().maxCoeff() < kSame; });
    if (!known) postures.push_back(q);
  }
  std::erase_if(postures, [&](const VectorXd& q) {
    const JointView one(q.data(), 1, q.size());
    const MotionCheck check = ws.check_motion(one, {.tip_contact = follower.tip_contact()});
    if (!check.free) {
      halt.reason = CutReason::kCollision;
      halt.link = check.link, halt.obstacle = check.obstacle, halt.other_link = check.other_link;
    }
    return !check.free;
  });
  std::ranges::stable_sort(postures, {},
                           [&](const VectorXd& q) { return (q - reference).squaredNorm(); });
  if (std::ssize(postures) > options.candidates) {
    postures.resize(static_cast<std::size_t>(options.candidates));
  }
  return postures;
}

std::int32_t next_reachable(const Workspace& ws, const PathFollower& follower, std::int32_t first,
                            const FollowOptions& options) {
  for (std::int32_t begin = first; begin < follower.size(); begin += kBlock) {
    const std::int32_t end = std::min(follower.size(), begin + kBlock);
    std::vector<double> targets;
    for (std::int32_t j = begin; j < end; ++j) {
      const auto numbers = row_major(follower.target(j).pose);
      targets.insert(targets.end(), numbers.begin(), numbers.end());
    }
    const InverseResult found = inverse(ws.arm(), targets, JointView(nullptr, 0, ws.arm().size()),
                                        inverse_options(options, kStartsLooking));
    const auto reached = std::ranges::find(found.status, InverseStatus::kReached);
    if (reached != found.status.end()) {
      return begin + static_cast<std::int32_t>(reached - found.status.begin());
    }
  }
  return follower.size();
}

}  // namespace bathyal::workspace
