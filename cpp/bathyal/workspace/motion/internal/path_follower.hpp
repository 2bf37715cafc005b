// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "bathyal/workspace/motion/follow.hpp"
#include "bathyal/workspace/motion/internal/tip_step.hpp"

namespace bathyal::workspace {

/// One row of a motion along a tool path.
struct PathRow {
  Eigen::VectorXd q;
  std::int32_t sample = -1;  ///< as in Followed
  double fraction = 0.0;
};

/// A tool path followed from one of its samples on, as far as it goes.
struct Stretch {
  std::vector<PathRow> rows;  ///< the last one at `last`
  std::int32_t first = 0, last = 0;
  bool complete = false;  ///< it ends at a gap or at the path's end
  FollowCut halt;         ///< else why: reason and what is in the way
};

/// Follows stretches of one tool path in the vehicle's frame.
class PathFollower {
 public:
  PathFollower(const Workspace& ws, const Bodies& bodies, const ToolPath& path,
               const FollowOptions& options);

  std::int32_t size() const { return static_cast<std::int32_t>(path_.size()); }
  bool gap_after(std::int32_t sample) const { return path_.gap[static_cast<std::size_t>(sample)]; }
  double length(const Stretch& stretch) const {
    return path_.arc_length[static_cast<std::size_t>(stretch.last)] -
           path_.arc_length[static_cast<std::size_t>(stretch.first)];
  }
  TipContact tip_contact() const { return tip_contact_; }

  /// At a sample, or between it and the next one.
  TipTarget target(std::int32_t sample, double fraction = 0.0) const;

  /// The target at a sample, moved out along a_j.
  TipTarget lifted(std::int32_t sample, double height) const;

  /// The posture near `q` that meets a target, held by `rules`; none with `halt` set.
  std::optional<Eigen::VectorXd> settle(const Eigen::VectorXd& q, const TipTarget& target,
                                        double comfort, FollowCut& halt);

  /// From a posture that is near to meeting the target of sample `first`.
  Stretch follow(const Eigen::VectorXd& q, std::int32_t first);

 private:
  bool advance(std::int32_t sample, Stretch& stretch);
  bool advance_to(std::int32_t sample, double fraction, int depth, double comfort,
                  Stretch& stretch);
  bool leg_is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to, FollowCut& halt) const;

  const Workspace& ws_;
  const ToolPath& path_;
  const FollowOptions& options_;
  TipContact tip_contact_;
  Pose vehicle_from_world_;
  TipStepper stepper_;
};

}  // namespace bathyal::workspace
