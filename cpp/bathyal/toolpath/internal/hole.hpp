// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/scene.hpp"

namespace bathyal::toolpath {

/// Around every vertex of the scene.
Eigen::AlignedBox3d bounds_of(const Scene& scene);

/// Whether an axis that meets nothing passes through a gap of the scene, as in find_targets.
/// `direction` is of unit length; `up` points away from the bottom; `bounds` are the scene's,
/// for a first look: a chord between two of its points lies inside.
bool passes_through_gap(const Scene& scene, const Eigen::AlignedBox3d& bounds, const Vec3& origin,
                        const Vec3& direction, const Vec3& up);

}  // namespace bathyal::toolpath
