// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/sonar/sonar.hpp"

namespace bathyal::sonar {

/// One-way power `off` half-power places off the axis of a line array: 1 at 0, ½ at 1.
double pattern_shape(BeamPattern kind, double off);

/// One-way power at `angle` from the direction that is steered to, in the plane of a line array
/// whose pattern is half at ±½ `width`. The array's own coordinate is the sine: steered to
/// `steered`, its lobes are those at sin(angle + steered) − sin(steered).
double pattern(BeamPattern kind, double angle, double width, double steered = 0.0);

/// How far from the axis rays of a beam go [rad]: the box's edge, or past the second side lobe.
double reach_of(BeamPattern kind, double width);

}  // namespace bathyal::sonar
