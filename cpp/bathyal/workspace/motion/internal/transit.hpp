// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bathyal/workspace/motion/internal/path_follower.hpp"

namespace bathyal::workspace {

/// From a posture on a tool path to another: lifted off along a_j, across without touching
/// anything, and down again.
class Transit {
 public:
  Transit(const Workspace& ws, const PathFollower& follower, const FollowOptions& options);

  /// Rows from `q` at sample `from` to where the tip is near sample `to`, in the posture that it
  /// comes in by damped steps; none where it does not come there.
  std::optional<JointMatrix> stepped(const Eigen::VectorXd& q, std::int32_t from,
                                     std::int32_t to) const;

  /// Rows to a posture `end` at sample `to`: straight in joint space between the lifted ones, or
  /// planned.
  std::optional<JointMatrix> planned(const Eigen::VectorXd& q, std::int32_t from,
                                     const Eigen::VectorXd& end, std::int32_t to) const;

 private:
  std::optional<JointMatrix> moved(const Eigen::VectorXd& q, const TipTarget& target,
                                   TipContact contact) const;
  std::optional<JointMatrix> lifted(const Eigen::VectorXd& q, std::int32_t sample) const;

  const Workspace& ws_;
  const PathFollower& follower_;
  const FollowOptions& options_;
};

}  // namespace bathyal::workspace
