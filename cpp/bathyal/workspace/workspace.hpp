// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/arm/kinematics.hpp"
#include "bathyal/geometry/rigid_body.hpp"
#include "bathyal/geometry/trajectory.hpp"
#include "bathyal/scene/scene.hpp"
#include "bathyal/workspace/arm_shape.hpp"
#include "bathyal/workspace/hull.hpp"
#include "bathyal/workspace/keepout.hpp"

namespace bathyal {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// What an arm hangs on and must not touch.
struct Surroundings {
  Pose vehicle_from_base = Pose::Identity();
  Trajectory world_from_vehicle;  ///< a pose at rest, or one over time
  /// Standard deviations of world_from_vehicle: of the origin along the vehicle's axes [m], then of
  /// the rotation vector in the vehicle's frame [rad]. Distances to what is fixed to the world are
  /// given less three standard deviations of where the vehicle may be.
  Vec6 vehicle_pose_std = Vec6::Zero();
  std::optional<Hull> hull;       ///< in the vehicle's frame
  std::optional<Scene> scene;     ///< in the world: the bottom and what lies on it
  std::vector<KeepOut> keepouts;  ///< each in the frame that it names; obstacles that move, too
  std::optional<RigidBody> vehicle_body;  ///< in the vehicle's frame, without the arm
  /// The arm's body; none: capsules_of_rows without radius.
  std::vector<LinkCapsule> capsules;
  /// Pairs of links, by index, that may touch.
  std::vector<std::pair<int, int>> allowed;
  double tip_depth = 0.0;  ///< to which the tool may be in the scene with TipContact::kAllowed [m]
};

/// Two bodies that are not compared, and why.
struct ExcludedPair {
  int link = 0;
  int other_link = -1;  ///< or -1, and
  int obstacle = -1;    ///< an index into obstacles()
  std::string reason;   ///< "foot", "neighbours", "allowed", "touch in every posture",
                        ///< "fixed to it"
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

  double least() const { return std::min(distance, self_distance); }
};

/// Whether the end of the tool may touch the scene: it must, to take a sample. What lies within two
/// radii (at least 1 mm) and Surroundings::tip_depth of the tip is then not compared with the
/// scene; all the rest of the arm is.
enum class TipContact { kForbidden, kAllowed };

struct MotionOptions {
  /// Of each row [s], rising; none: at 0, or, where something moves in the world, refused.
  std::span<const double> time = {};
  /// Whether the arm must be able to stop, too: at every moment it may run on along the line
  /// between two rows by its stopping distance, speed² / (2 acceleration) of the coordinate that
  /// stops last; what moves is counted while it stops. The contact is then the last moment at which
  /// an order to stop comes in time. Needs `time`.
  bool stopping = false;
  /// With which each coordinate brakes [rad/s²], [m/s²]; none: default_acceleration.
  std::span<const double> acceleration = {};
  TipContact tip_contact = TipContact::kForbidden;
};

/// The first contact of a motion.
struct MotionCheck {
  bool free = true;
  /// Row and fraction of the way to the next; NaN of a free motion.
  double contact = std::numeric_limits<double>::quiet_NaN();
  double time =
      std::numeric_limits<double>::quiet_NaN();  ///< of the contact [s], of a timed motion
  int link = -1;
  int obstacle = -1;    ///< or -1, and
  int other_link = -1;  ///< of the arm's own
};

/// What of a target forbids it: the first that holds.
enum class TargetIndicator {
  kHull,         ///< inside the vehicle's hull
  kKeepOut,      ///< inside a keep-out
  kGround,       ///< under the bottom
  kUnreachable,  ///< in no posture within the limits, in any orientation of the tool
  kCollision,    ///< only by postures that touch something
  kLimit,        ///< only by postures that have a joint within 0.01 rad, 1 mm of a limit
  kFree
};

struct TargetCheck {
  TargetIndicator status = TargetIndicator::kFree;
  int keepout = -1;  ///< that the point lies in: an index into the keep-outs given
  /// From the point to the nearest of hull, keep-outs and ground [m], below 0 inside; inf if there
  /// are none.
  double distance = std::numeric_limits<double>::infinity();
  std::vector<double> q;  ///< a posture that reaches it; empty where there is none
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
  /// it is fixed to, the foot and all obstacles, and what touches in every one of 64 postures drawn
  /// within the limits: it is made so (unless that goes for the hull and all links).
  const std::vector<ExcludedPair>& excluded() const;

  /// What looks like a mistake: a hull that is a hundred times as large as the arm or as small, as
  /// where millimetres were taken for metres, or far from its base; a keep-out that holds the base.
  const std::vector<std::string>& warnings() const;

  /// The smallest distances of each row of q, (N, n), at a time for all of them, or one each.
  /// \throw std::invalid_argument as check_joint_values, for another count of times.
  std::vector<Clearance> clearance(JointView q, std::span<const double> time = {},
                                   TipContact tip_contact = TipContact::kForbidden,
                                   int num_threads = 0) const;

  /// Whether the motion along the rows of q, (M, n), joined by straight lines in joint space, is
  /// free of contact everywhere, and where the first contact is.
  ///
  /// An interval is free when in its middle every distance is larger than what the motion to its
  /// ends can take any point by (`displacement_bound`; what moves in the world is counted with its
  /// greatest speeds); else it is halved, the earlier half first. No obstacle is stepped over. A
  /// body that stays nearer than 10⁻⁵ m may count as contact; the place of one is the middle of an
  /// interval shorter than 10⁻³ of a row.
  /// \throw std::invalid_argument as check_joint_values, for no row, times that do not rise or of
  ///        another count, accelerations that are not positive.
  MotionCheck check_motion(JointView q, const MotionOptions& options = {}) const;

  /// Whether the arm may be sent to points in the world, (N, 3), at one time. Postures are looked
  /// for by inverse kinematics of the point alone, from several starts; their tip may touch the
  /// scene. The result of a point does not depend on the others.
  /// \throw std::invalid_argument for a point that is not finite.
  std::vector<TargetCheck> check_target(PointView points, double time = 0.0, std::uint64_t seed = 0,
                                        int num_threads = 0) const;

  /// The capsules of each row of q, in the vehicle's frame: those of surroundings(), (N, C).
  /// \throw std::invalid_argument as check_joint_values.
  std::vector<Capsule> placed_capsules(JointView q) const;

  /// Whether the distances of a motion depend on the time: the vehicle moves, and there is
  /// something fixed to the world; or a keep-out moves.
  bool moves() const;

  /// The same, the vehicle elsewhere. Shares what it can.
  Workspace with_vehicle_pose(Trajectory world_from_vehicle) const;

  /// The same, with another Surroundings::tip_depth.
  /// \throw std::invalid_argument for one that is negative or not finite.
  Workspace with_tip_depth(double tip_depth) const;

  /// The same with a tool or a sample in the arm's hand: capsules fixed to the last link, in the
  /// tool's frame, and what it weighs, in the tool's frame. They are not compared with the last
  /// link.
  Workspace attach(std::span<const Capsule> capsules, const RigidBody& body) const;

  /// Without what was attached. \throw std::invalid_argument where nothing was.
  Workspace detach() const;

  /// What is attached, in the tool's frame; without mass where nothing is.
  const RigidBody& attached() const;
  const std::vector<Capsule>& attached_capsules() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Of each coordinate: its rate limit is reached from rest in half a second; 1 rad/s², 0.5 m/s²
/// where a joint has none.
std::vector<double> default_acceleration(const Arm& arm);

}  // namespace bathyal
