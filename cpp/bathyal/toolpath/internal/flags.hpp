// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/toolpath/toolpath.hpp"

namespace bathyal::toolpath {

/// Sets `crossing`, for a path with standoff: samples where the tool's point turns back against
/// its travel, and all samples of a loop that path makes in the upright plane of its
/// segment (the swallowtail over ground more concave than the standoff; loops shorter than ten
/// standoffs along the bottom are looked for). Without standoff nothing is flagged: the path is the
/// bottom's own section.
void flag_crossings(ToolPath& path, const Vec3& up, double standoff);

/// The same for a rolled path, whose travel is that of the ball: loops are added to the stretches
/// rolled backwards, which are flagged already.
void flag_rolled_crossings(ToolPath& path, const Vec3& up, double standoff);

/// The tool's body: a capsule of `radius` whose round end touches the tool's point and which
/// reaches `length` back from there along a.
struct ToolBody {
  double radius;     ///< [m], 0 for the axis only
  double length;     ///< [m], 0 for no body
  double tolerance;  ///< how far ground may reach into it [m]
};

/// Sets `contact` where ground reaches further than the tolerance into the body. Exact: balls of
/// the distance to the nearest ground are strung along the capsule's axis, and the axis is cast. A
/// plane never meets the body of a tool that touches it.
void flag_contacts(ToolPath& path, const Surface& surface, const ToolBody& body, int num_threads);

}  // namespace bathyal::toolpath
