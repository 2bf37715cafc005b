// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bathyal/toolpath/targets.hpp"

namespace bathyal {

enum class Orientation {
  kBlended,           ///< every turn is spread over blend_length of the path
  kPiecewiseConstant  ///< the paper's: constant on a facet, T_j twice on an edge, once per facet
};

/// How the tool's point keeps its standoff.
enum class Offset {
  kRolling,  ///< the way of the centre of a ball of that radius that rolls over the bottom
  kPlain     ///< every sample moved along its own a_j
};

enum class MissedAims {
  kLeaveOut,  ///< warned of; the stretch over them is a gap
  kRefuse     ///< an error that names them
};

struct ToolPathOptions {
  TargetOptions targets;
  MissedAims missed = MissedAims::kLeaveOut;  ///< what to do with aims that have no target
  Orientation orientation = Orientation::kBlended;
  double blend_length = 0.1;         ///< path over which one turn is spread [m], above 0
  double angular_rate = 0.5;         ///< of the tool's whole frame [rad/s], above 0
  double speed = 0.1;                ///< of the tool's point along its path [m/s], above 0
  double acceleration = 0.1;         ///< along the path [m/s²], above 0
  double standoff = 0.0;             ///< of the tool's point from the bottom [m], 0 or more
  Offset offset = Offset::kRolling;  ///< how it is kept; without standoff the same
  double step = 0.0;           ///< longest stretch between samples on the bottom [m]; 0: T_j as cut
  double normal_radius = 0.0;  ///< of the footprint normals are taken over [m]; 0: facet normals
  double tool_radius = 0.0;    ///< of the tool's body [m]; 0: its axis only
  double tool_length = 0.0;    ///< of the tool's body from its point back along a [m]; 0: no body
  double contact_tolerance = 0.01;  ///< how far ground may reach into the body unflagged [m]

  void check() const;
};

/// An oriented path, one sample a row, in the world frame.
struct ToolPath {
  std::vector<Vec3>
      position;  ///< the tool's point: surface + standoff · a [m] (rolling: see there)
  std::vector<Vec3> surface;   ///< T_j, on the bottom; what the ball touches [m]
  std::vector<Vec3> approach;  ///< a_j, unit, out of the bottom; the tool's z is −a_j
  std::vector<Vec3> travel;    ///< n_j, unit, perpendicular to a_j
  std::vector<Vec3> side;      ///< b_j = a_j × n_j
  std::vector<std::array<double, 4>> quaternion;  ///< x y z w of [n, −b, −a], continuous in sign
  std::vector<std::int32_t> segment;              ///< i of the pair A_i A_{i+1} (rows of the aims)
  std::vector<std::int32_t> mesh;                 ///< −1 on a plane
  std::vector<std::int32_t> triangle;  ///< facet of the stretch that begins here, −1 on a plane
  std::vector<bool> gap;               ///< the stretch from here to the next sample crosses a gap
  std::vector<double> arc_length;      ///< along the positions, from 0 [m]
  std::vector<double> time;            ///< from 0, never falling [s]
  std::vector<double> normal_std;      ///< of a_j [rad], NaN where unknown (see estimate_normals)
  std::vector<bool> crossing;          ///< the path at standoff turns back or crosses itself here
  std::vector<bool> contact;           ///< the tool's body meets ground here
  Targets targets;
  std::vector<std::string> warnings;

  std::size_t size() const { return position.size(); }

  /// world_from_tool: rotation columns [n, −b, −a], translation the position.
  Pose frame(std::size_t j) const;
};

/// Plans the path of a tool along the bottom through the targets the camera axes point at, in their
/// order.
///
/// Steps: find_targets; the section between each pair and the next, following the sheet that joins
/// them (follow_sheet says what happens on overhangs, vertical pairs, gaps); a normal per facet or
/// footprint (estimate_normals); frames, constant per facet or blended; standoff; time stamps;
/// flags.
///
/// - n_j is T_jT_{j+1} made perpendicular to a_j, so that [n, −b, −a] is a rotation.
/// - Blended: the turn from one facet's frame to the next's, and at a target from one heading to
///   the next, is spread smoothly over blend_length of path, half before and half after; samples
///   are added there. Turns closer than that add up. Away from edges a_j is the facet's normal.
/// - Piecewise constant: the tool stops at an edge and turns in place at angular_rate.
/// - Standoff, rolling: the tool's point is the centre of a ball of radius `standoff` that rolls
///   over the whole scene from target to target. The centre keeps to the upright plane of each
///   section, moved sideways by standoff times the section's mean sine of the slope across it, so
///   that on an even slope the ball touches the section itself. `surface` is what it touches, up to
///   the standoff off the section, and a_j points from there to the centre. No sample is nearer to
///   the bottom than `standoff`; two samples d apart leave no point of the straight stretch between
///   them nearer than √(standoff² − d²/4). A hollow too narrow for the ball it touches on both
///   sides and passes over; there a_j jumps, and the jump is blended (over two standoffs at most)
///   or turned in place as between facets. A target it cannot touch is passed straight above.
///   Where a_j is blended, and where normal_radius > 0 and a_j is the normal of the footprint round
///   what is touched, it is not the direction from `surface` to `position`. A section that cannot
///   be rolled over keeps the plain offset, raised off the bottom, with a warning. On a plane, and
///   for a standoff of 10 µm or less, both ways are the same. `tool_radius` plays no part: a body
///   wider than the standoff may meet ground, which `contact` flags.
/// - Standoff, plain: over ground more concave than the standoff the path turns back or crosses
///   itself and comes nearer to the bottom than that; `crossing` flags it.
/// - A gap is crossed in a straight line between two samples, the first with its gap flag set; no
///   surface is claimed between them, no step divides it, and the tool is at rest at both its ends.
///   What happens there is for the executing system to decide.
/// - Aims without a target are warned of and the stretch over them is a gap, since the bottom
///   between their neighbours is not what was aimed at; missed = kRefuse makes them an error.
/// - Targets that coincide (to 1 µm) give no length and no stop, and a warning. One target gives
///   one sample, n_j along the world's x as far as a_j lets it.
/// - Speed, acceleration along the path and angular rate hold between any two samples; it starts
///   and ends at rest.
///
/// \throw std::invalid_argument for no aims, aims that are not finite, no target at all, or a step
/// or normal_radius that asks for more than 10⁸ parts.
/// Filaretov, Konoplin, Konoplin (2018), section 2.
ToolPath plan_toolpath(const Surface& surface, const Aims& aims,
                       const ToolPathOptions& options = {});

}  // namespace bathyal
