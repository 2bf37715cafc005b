// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/toolpath/toolpath.hpp"
#include "bathyal/workspace/workspace.hpp"

// A tool path as joint motion.

namespace bathyal {

/// Why a stretch of a tool path is not followed.
enum class CutReason {
  kUnreachable,  ///< in no posture, with limits or without
  kLimit,        ///< only beyond joint limits
  kCollision,    ///< only by postures that touch something
  kSingular,     ///< the arm would have to jump
  kNoTransit     ///< there are postures for it, and no way to them was found
};

/// "unreachable", "limit", "collision", "singular" or "no_transit".
std::string_view to_text(CutReason reason);

/// The tool path from sample `first` to sample `last` is not followed; its ends may be, as the end
/// and the beginning of what is. The reason is that at its beginning.
struct FollowCut {
  std::int32_t first = 0, last = 0;
  CutReason reason = CutReason::kUnreachable;
  int link = -1, obstacle = -1, other_link = -1;  ///< of kCollision, as in MotionCheck
  int coordinate = -1;                            ///< of kLimit
};

struct FollowOptions {
  /// kPositionAxis: the turn about the tool's z is free; kPose: its x runs along the path, too.
  InverseTask task = InverseTask::kPositionAxis;
  double position_tolerance = 1e-4;  ///< at every row [m], above 0
  double angle_tolerance = 1e-3;     ///< at every row [rad], above 0
  double step = 0.01;                ///< of the tool path between rows at most [m], above 0
  double lift = 0.1;                 ///< height at which gaps are crossed, along a_j [m], above 0
  double shortest = 0.05;            ///< stretch between cuts that is worth going to [m], 0 or more
  double transit_speed = 0.1;        ///< of the tip on the way there at most [m/s], above 0
  double transit_rate = 0.5;         ///< of the tool on the way there at most [rad/s], above 0
  double clearance = 0.002;          ///< that is kept [m], 0 or more
  double influence = 0.1;  ///< what is nearer is kept away by redundancy [m], above clearance
  int candidates = 8;      ///< postures tried at the beginning of a stretch, 1 to 10³
  std::vector<double> velocity{};      ///< of each coordinate [rad/s], [m/s]; none: as MoveOptions
  std::vector<double> acceleration{};  ///< none: default_acceleration
  std::vector<double> q_start{};  ///< (n,) posture near which to begin; none: the best there is
  /// Whether the tip may touch the scene; when nothing is said, where the path has no standoff.
  std::optional<TipContact> tip_contact = std::nullopt;
  double time = 0.0;       ///< at which it begins [s]
  std::uint64_t seed = 0;  ///< of the postures

  /// \throw std::invalid_argument
  void check(const Arm& arm) const;
};

struct Followed {
  JointMatrix q;             ///< (K, n), rows joined by straight lines
  std::vector<double> time;  ///< (K,) rising [s]
  /// (K,) of the tool path, at or before the row; −1 in transit. Samples that coincide share a row,
  /// which has the last of them.
  std::vector<std::int32_t> sample;
  std::vector<double> fraction;  ///< (K,) of the way to the next sample; 0 in transit
  std::vector<FollowCut> cut;
  double position_error = 0.0;  ///< greatest of the rows that are not in transit [m]
  double angle_error = 0.0;     ///< [rad]; 0 for kPosition
};

/// Follows a tool path of plan_toolpath, sample by sample, with rows between where samples are far
/// apart: by the priorities of MoveMethod::kDamped (limits; clearance; position; axis or
/// orientation; away from limits and from what is near). The path's times are kept where the arm
/// can; near singular postures, and wherever rates or accelerations would be passed, it is slowed.
///
/// It begins in that of several postures with which the longest stretch is followed. At a gap, and
/// where a stretch ends, the tool is lifted along a_j, taken across and brought down again; what no
/// posture follows is cut out. All rows and all lines between them are free of contact
/// (Workspace::check_motion), touch of the tip with the scene apart as `tip_contact` says: off the
/// path only while lifting and coming down. It begins and ends at rest on the path: to where it
/// begins, and away from where it ends, plan.
/// \throw std::invalid_argument for a workspace that moves, a path without samples or with frames
///        that are not finite, options out of range.
Followed follow_toolpath(const Workspace& ws, const ToolPath& path,
                         const FollowOptions& options = {});

}  // namespace bathyal
