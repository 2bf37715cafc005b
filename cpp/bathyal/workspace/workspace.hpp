// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/scene/scene.hpp"
#include "bathyal/workspace/arm_shape.hpp"
#include "bathyal/workspace/hull.hpp"
#include "bathyal/workspace/keepout.hpp"

namespace bathyal {

/// What an arm hangs on and must not touch.
struct Surroundings {
  Pose vehicle_from_base = Pose::Identity();
  Pose world_from_vehicle = Pose::Identity();
  std::optional<Hull> hull;       ///< in the vehicle's frame
  std::optional<Scene> scene;     ///< in the world: the bottom and what lies on it
  std::vector<KeepOut> keepouts;  ///< each in the frame that it names
  /// The arm's body; none: capsules_of_rows without radius.
  std::vector<LinkCapsule> capsules;
  /// Pairs of links, by index, that may touch.
  std::vector<std::pair<int, int>> allowed;
};

/// Two bodies that are not compared, and why.
struct ExcludedPair {
  int link = 0;
  int other_link = -1;  ///< or -1, and
  int obstacle = -1;    ///< an index into obstacles()
  std::string reason;   ///< "neighbours", "allowed", "touch in every posture", "fixed to it"
};

/// How near a posture comes to what must not be touched. Points are in the vehicle's frame, on the
/// axis of a capsule and on the obstacle.
struct Clearance {
  double distance = std::numeric_limits<double>::infinity();  ///< [m], below 0 where they overlap
  int link = -1;
  int obstacle = -1;
  Vec3 axis_point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 obstacle_point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  double self_distance = std::numeric_limits<double>::infinity();  ///< between the arm's own links
  std::pair<int, int> self_links{-1, -1};
};

/// The first contact of a motion.
struct MotionCheck {
  bool free = true;
  /// Row and fraction of the way to the next; NaN of a free motion.
  double contact = std::numeric_limits<double>::quiet_NaN();
  int link = -1;
  int obstacle = -1;    ///< or -1, and
  int other_link = -1;  ///< of the arm's own
};

/// An arm on a vehicle among obstacles (Maevskiy, Zanin 2020). The arm's own base plays no part:
/// it hangs at `vehicle_from_base`. Its foot, link 0, is bolted to the vehicle and touches nothing.
/// Immutable, cheap to copy; any number of threads may query it.
class Workspace {
 public:
  /// \throw std::invalid_argument for poses that are not rigid, a keep-out whose frame is neither
  ///        "hull", "world" nor a link's name, capsules or allowed pairs of links that are not
  ///        there.
  Workspace(Arm arm, Surroundings surroundings);

  /// With its base in the vehicle's frame.
  const Arm& arm() const;
  const Surroundings& surroundings() const;

  /// What clearance().obstacle counts: "hull", the keep-outs' names, "scene"; those given.
  const std::vector<std::string>& obstacles() const;

  /// Pairs that are not compared: neighbouring links, those allowed, an obstacle and the link that
  /// it is fixed to, and what touches in every one of 64 postures drawn within the limits: it is
  /// made so.
  const std::vector<ExcludedPair>& excluded() const;

  /// The smallest distances of each row of q, (N, n).
  /// \throw std::invalid_argument as check_joint_values.
  std::vector<Clearance> clearance(JointView q, int num_threads = 0) const;

  /// Whether the motion along the rows of q, (M, n), joined by straight lines in joint space, is
  /// free of contact everywhere, and where the first contact is.
  ///
  /// An interval is free when in its middle every distance is larger than what the motion to its
  /// ends can take any point by (`displacement_bound`); else it is halved, the earlier half first.
  /// No obstacle is stepped over. A body that stays nearer than 10⁻⁵ m may count as contact; the
  /// place of one is the middle of an interval shorter than 10⁻³ of a row.
  /// \throw std::invalid_argument as check_joint_values, and for no row.
  MotionCheck check_motion(JointView q) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace bathyal
