// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/workspace/sampling/internal/tip_line.hpp"
#include "bathyal/workspace/sampling/sampling.hpp"

namespace bathyal::workspace {

/// Where a sample is taken. In the vehicle's frame, but for what says otherwise.
struct SamplingSite {
  Vec3 world_contact = Vec3::Zero();
  Vec3 world_direction = Vec3::Zero();
  Vec3 before = Vec3::Zero();   ///< contact, a standoff before it
  Vec3 contact = Vec3::Zero();  ///< where the tip meets the bottom
  Vec3 deepest = Vec3::Zero();  ///< where it is pressed to
  double depth = 0.0;           ///< from contact to deepest [m]
  bool has_bottom = true;
  double under = 0.0;  ///< how deep under the bottom the target is [m]
  TipAim aim;
};

SamplingSite sampling_site(const Workspace& workspace, const Vec3& target,
                           const SamplingOptions& options);

/// The workspace with the tool in the arm's hand, and at its pose.
Workspace with_tool(const Workspace& workspace, const SamplingOptions& options);

}  // namespace bathyal::workspace
