// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/internal/inverse_search.hpp"

namespace bathyal::arm {

/// The pseudo-inverse stepping of Maevskiy and Zanin (2020): dq = J⁺ dX, the way to the target cut
/// into equal steps, then corrections until the tolerance is met. Limits are not looked at on the
/// way: a pose that no whole turn brings within them ends with kLimit, a Jacobian without full rank
/// with kSingular.
std::unique_ptr<InverseRows> make_stepping(const Arm& arm, const InverseOptions& options);

}  // namespace bathyal::arm
