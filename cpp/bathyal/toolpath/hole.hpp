// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/scene.hpp"

namespace bathyal {

/// Whether an axis that meets nothing passes through a gap of the scene, as find_targets says it.
/// `direction` is of unit length; `up` tells which way the bottom lies.
bool passes_through_gap(const Scene& scene, const Vec3& origin, const Vec3& direction,
                        const Vec3& up);

}  // namespace bathyal
