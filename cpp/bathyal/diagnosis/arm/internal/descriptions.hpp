// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bathyal/arm/arm.hpp"
#include "bathyal/effects/effect.hpp"

namespace bathyal::diagnosis {

/// "a wave of order 2 along joint 3 (elbow)": joints counted from 1.
std::string description_of(const EffectVariant& variant, const Arm& arm);

/// Whether it has an order, and that is a whole number.
bool has_whole_order(const EffectVariant& variant);

}  // namespace bathyal::diagnosis
