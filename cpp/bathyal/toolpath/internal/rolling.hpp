// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/toolpath/internal/roll.hpp"
#include "bathyal/toolpath/internal/route.hpp"

namespace bathyal::toolpath {

/// The ball's way along one run, in its order: never none.
using RolledRun = std::vector<Rest>;

struct RolledRoute {
  std::vector<RolledRun> runs;
  std::vector<std::string> warnings;
};

/// Rolls a ball of the radius along the route, leg by leg (`roll`), every leg in the upright plane
/// of its section, moved sideways by the radius times the leg's mean sine of the slope across it:
/// on an even slope the ball then touches the section itself. All triangles of the scene count,
/// those next to the section too, so that what the ball touches may lie off the section by up to
/// the radius.
///
/// - A leg begins and ends where the ball touches its targets (from the target along the facet's
///   normal within the plane). Where that centre is not free, it is raised along `up` till it is,
///   and where `up` leads nowhere, along the normal.
/// - Where two legs meet at an angle, their planes' common line is the place, raised along `up`.
///   Elsewhere the ball goes straight from the end of the one to the
///   beginning of the other, raised or lowered along the approach till it touches.
/// - Where that is shorter than twice the leg and the radius are, or the only way, a leg is rolled
///   backwards, which is marked: its targets touch the ball in the other order.
/// - A leg that cannot be rolled (ends in a pocket the ball does not get out of, a facet along the
///   plane) keeps the plain offset, raised along the normals till it is free, with a warning.
/// - Nothing rolls across a gap.
RolledRoute roll_along(const Route& route, const Scene& scene, const Targets& targets,
                       const Vec3& up, double radius, int num_threads);

}  // namespace bathyal::toolpath
