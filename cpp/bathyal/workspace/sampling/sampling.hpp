// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/workspace/motion/motion_timing.hpp"
#include "bathyal/workspace/workspace.hpp"

// A soil sample, taken as Maevskiy, Zanin (2020) do: approach, press, grab, lift, transport.

namespace bathyal {

/// What the arm holds: its shape and its weight, in the tool's frame.
struct HeldBody {
  std::vector<Capsule> capsules;
  RigidBody body;
};

struct SamplingOptions {
  /// Where the arm starts; empty: stowed_posture.
  std::vector<double> q_start = {};
  /// In which the sample is carried; empty: the start.
  std::vector<double> q_transport = {};
  HeldBody tool = {};  ///< attached all the time
  /// flange_from_tool in place of the arm's own.
  std::optional<Pose> tool_pose = std::nullopt;
  HeldBody sample = {};  ///< attached from the end of the grab on

  /// Into the bottom, in the world, any length but zero; none: against the bottom's normal, the
  /// mean of those within 5 cm of the target, turned upwards; without a scene straight down.
  std::optional<Vec3> direction = std::nullopt;
  /// Whether `tool_axis` points along the direction; none: of arms with five coordinates or more.
  std::optional<bool> align = std::nullopt;
  Vec3 tool_axis = Vec3::UnitZ();  ///< in the tool's frame
  double standoff = 0.1;           ///< of the tip before contact, above 0 [m]

  double depth = 0.02;         ///< that the tip is pressed into the bottom, 0 or more [m]
  double stiffness = 5000.0;   ///< of the bottom, 0 or more [N/m]
  double force_limit = 100.0;  ///< with which the tip is pressed at most, above 0 [N]
  double grab_time = 3.0;      ///< above 0 [s]
  double press_speed = 0.02;   ///< of the tip while it presses and lifts, at most, above 0 [m/s]
  /// How far the tip may leave the straight line while it presses and lifts, above 0 [m].
  double line_tolerance = 1e-3;

  MotionLimits limits = {};
  double step = 0.02;  ///< between rows, at most; longer where the tip is held back [s], above 0
  double time = 0.0;   ///< when the arm starts [s]: things may move
  /// Postures and straight motions looked at for contact by all planned motions together, each of
  /// which may use a quarter of them, 1 to 10⁸.
  int max_checks = 20000;
  std::uint64_t seed = 0;

  bool inertia = false;                 ///< whether the wrench has the inertia of what moves
  Vec3 gravity = {0.0, 0.0, -9.80665};  ///< in the world [m/s²]
  double water_density = 1025.0;        ///< [kg/m³], 0 or more
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

enum class SamplingStatus {
  kPlanned,
  kStart,        ///< the start, or the transport posture, touches or is outside the limits
  kForbidden,    ///< the target is inside hull or keep-out, or deeper under the bottom than `depth`
  kNoBottom,     ///< the scene has none within a standoff of the target, along the direction
  kUnreachable,  ///< no posture, or no straight way, reaches the target
  kCollision,    ///< only by touching what must not be touched
  kNoApproach,   ///< no motion to the place before contact was found
  kNoTransport,  ///< none from there, with the sample
  kNoRetreat     ///< none that may be turned back on: something moves in its way
};

/// "planned", "start", "forbidden", "no_bottom", "unreachable", "collision", "no_approach",
/// "no_transport", "no_retreat"
std::string_view to_text(SamplingStatus status);

/// One part of taking a sample, from rest to rest; the first row is the last of the phase before.
struct SamplingPhase {
  std::string name;          ///< "approach", "press", "grab", "lift" or "transport"
  JointMatrix q;             ///< (K, n), straight in joint space between rows
  std::vector<double> time;  ///< (K,) rising over all phases [s]
  std::vector<Pose> tip;     ///< vehicle_from_tool of each row
  /// (R, n): from the last row to where the arm is safe: of "approach" its start, of "press",
  /// "grab" and "transport" the place before contact, of "lift" the transport posture. Straight
  /// between rows; free of contact, as the phase is, with what is held then. From an earlier row
  /// of "approach", "press" and "transport" the phase's own rows, run backwards, lead to the same
  /// place; those of "grab" and "lift" are followed to the end, then the retreat.
  JointMatrix retreat;
  std::vector<double> retreat_time;  ///< (R,) from 0 [s]
  std::size_t first = 0;             ///< which row of the whole plan is the first of q
};

struct SamplingPlan {
  SamplingStatus status = SamplingStatus::kUnreachable;
  std::string reason;                 ///< one sentence; empty of a plan
  std::vector<SamplingPhase> phases;  ///< five, or none
  /// (T,) of all phases, rows that two of them share given once [s].
  std::vector<double> time;
  /// (T, 6) on the vehicle by arm, what it holds and bottom, in its frame about its origin
  /// [N, N m]. Of a shared row with what was held before it.
  std::vector<double> wrench;
  std::vector<double> contact_force;  ///< (T,) of the bottom on the tip, against the direction [N]
  Vec3 contact = Vec3::Zero();        ///< where the tip meets the bottom, in the world
  Vec3 direction = Vec3::Zero();      ///< unit, into the bottom, in the world
  double depth = 0.0;                 ///< pressed [m]: min(depth, force_limit / stiffness)
};

/// How to take a sample at a point in the world.
///
/// The contact is where the line through the target along the direction first meets the scene
/// within a standoff before and behind the target; without a scene the target itself. The tip
/// approaches to the standoff before it (`plan_motion`, touching nothing), presses straight on by
/// min(depth, force_limit / stiffness), grabs for `grab_time`, lifts straight back with the sample,
/// and is carried to the transport posture (`plan_motion` again). Press, grab and lift may touch
/// the scene with the end of the tool (TipContact), all else nowhere. Straight ways of the tip are
/// followed by inverse kinematics in steps, then checked between the rows: nowhere farther than
/// `line_tolerance` from the line. The bottom pushes the tip back by stiffness times penetration,
/// while the tip presses, grabs and lifts. Postures before contact are tried in the order of how
/// far they are from the start. The same seed gives the same bytes. \throw std::invalid_argument
/// for a target that is not finite, a vehicle that moves, a start or
///        transport posture of another length or not finite, and as SamplingOptions::check,
///        Workspace::attach and complete_limits.
SamplingPlan plan_sampling(const Workspace& workspace, const Vec3& target,
                           const SamplingOptions& options = {});

/// A free posture to start from: with all coordinates at zero, or the nearest to it within the
/// limits; else in the middle of the limits; else of 64 drawn within them that with the largest
/// clearance. Empty where none is free.
std::vector<double> stowed_posture(const Workspace& workspace, double time = 0.0,
                                   std::uint64_t seed = 0);

}  // namespace bathyal
