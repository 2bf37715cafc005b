// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/model/arm_parameters.hpp"

// Effects as columns of an arm. For use inside identification and diagnosis.

namespace bathyal {

/// "joint_harmonic(joint=2,order=2)": a form of an effect, told from all others.
std::string variant_name(const EffectVariant& variant);

/// Appends a column for each parameter, named as "joint_harmonic(joint=2,order=2).cos", of the
/// group variant_name, nominal 0. Its scale is that at which the action's rms, or that of the
/// largest of its actions, is a milliradian, a millimetre or a thousandth: about a millimetre at
/// the tip, as of the arm's own columns. Nothing takes an effect back but truncate_columns.
///
/// A column acts at its value whether it is free or not: to hold an effect, give its columns the
/// value as nominal and leave them out of ArmSystem::set_free.
/// \pre actions are as actions_of returns them, for the rows of the measurement
/// \return the first of them
int add_effect(ArmColumns& columns, const EffectVariant& variant,
               std::vector<std::vector<Action>> actions);

/// Only the first `count` columns; actions go with their columns.
void truncate_columns(ArmColumns& columns, std::size_t count);

/// How many columns stand before the first effect.
std::size_t geometry_columns(const ArmColumns& columns);

}  // namespace bathyal
