// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/toolpath/internal/rolling.hpp"
#include "bathyal/toolpath/toolpath.hpp"

namespace bathyal::toolpath {

/// Samples of a rolled route. Every array is filled up to the gap flag and normal_std, the
/// position, which is the ball's centre, and crossing for legs rolled backwards; `route` gives the
/// pairs whose gaps end the runs.
///
/// The approach is the ball's own, from what it touches to its centre, exact at every sample away
/// from turns and continuous between them. It jumps where the ball touches two triangles at once,
/// and the heading jumps at targets. Blended: every jump is spread over `blend_length` of the way,
/// at most twice the radius, over which the ball may have turned anyhow,
/// half before and half after, in the cumulative form of sample_blended. Piecewise constant: two
/// samples at one position, between which the tool turns in place.
///
/// With `normal_radius` > 0 the approach is the normal of the footprint round what is touched
/// (estimate_normals) instead, which changes from touch to touch; positions stay the ball's.
ToolPath sample_rolled(const RolledRoute& rolled, const Route& route, const Scene& scene,
                       const ToolPathOptions& options);

}  // namespace bathyal::toolpath
