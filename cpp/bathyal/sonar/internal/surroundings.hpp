// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/water/water.hpp"
#include "bathyal/world/snapshot.hpp"

namespace bathyal::sonar {

/// Height above what lies straight below [m]; NaN where nothing does.
/// \throw std::invalid_argument for a sonar above the surface, below the bottom or inside a body:
///        what lies straight above and below shows it the side that it is not seen from.
double checked_altitude(const WorldSnapshot& world, const Water& water, const Vec3& sonar);

}  // namespace bathyal::sonar
