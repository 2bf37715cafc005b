// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/workspace/workspace.hpp"

namespace bathyal {

struct StandpointOptions {
  double voxel = 0.05;           ///< of the reach map that the search goes by [m], above 0
  int headings = 24;             ///< looked at first, evenly over a turn; 1 to 360
  double step = 0.1;             ///< between the places looked at first [m], above 0
  double hull_clearance = 0.05;  ///< that the hull keeps from bottom and keep-outs [m], 0 or more
  int refined = 12;              ///< places that are refined and checked, 1 to 1000
  int alternatives = 3;          ///< at most, 0 or more
  std::uint64_t seed = 0;        ///< of the reach map and the checks of targets
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

enum class StandpointStatus {
  kAll,      ///< every target is reached
  kSome,     ///< not every one
  kNoReach,  ///< the arm reaches no place free of its own hull and keep-outs
  kNoRoom,   ///< wherever a target would be reached the hull is too near to bottom or keep-outs
  kBlocked,  ///< the hull has room, and the arm touches something on each target
};

/// "all", "some", "no_reach", "no_room", "blocked".
std::string_view to_text(StandpointStatus status);

/// A pose of the vehicle, level, and what the arm reaches from there.
struct StandpointPlace {
  Pose world_from_vehicle = Pose::Identity();
  /// Number of targets reached, and the mean margin of those, in (0, 1): depth / (depth + 0.1 m),
  /// where the depth is the distance from the target to the border of the part of the reach map
  /// that is free: how far the vehicle may be off, scene left out. 0 where none is reached.
  double score = 0.0;
  std::vector<std::uint8_t> reached;  ///< of each target, 1 where check_target says free
};

struct Standpoint {
  StandpointStatus status = StandpointStatus::kNoReach;
  std::string reason;  ///< one sentence
  /// Best first, the others at least 0.2 m or 20 degrees away from those before them; none unless a
  /// target is reached.
  std::vector<StandpointPlace> places;
};

/// Where to put the vehicle, level, so that the arm reaches most of `targets`, (N, 3) in the world,
/// with the best margin, at time 0 where something moves.
///
/// `surroundings.world_from_vehicle` plays no part. Places on a lattice and headings are scored by
/// the reach map of arm, hull and what is fixed to them; of the best that leave the hull room a few
/// are moved uphill, and those are scored by Workspace::check_target, which decides.
///
/// The hull has room where it keeps `hull_clearance` from the bottom's triangles (exact) and lies
/// above them, seen from above; where the scene has no bottom it must lie above the scene's highest
/// point. It keeps as far from keep-outs fixed to the world: exact, but where a cylinder or a cone
/// faces the middle of one of the hull's triangles, which is decided by 16 of its lines. The arm
/// keeps out of them in the checks of targets. Without a hull, that goes for the vehicle's origin.
/// \throw std::invalid_argument for no target, one that is not finite, options out of range, and as
///        Workspace and reach_map.
Standpoint best_standpoint(const Arm& arm, const Surroundings& surroundings, PointView targets,
                           const StandpointOptions& options = {});

}  // namespace bathyal
