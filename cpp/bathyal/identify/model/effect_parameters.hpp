// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/identify/model/arm_parameters.hpp"

// Effects as parameters of an arm.

namespace bathyal {

/// "joint_harmonic(joint=2,order=2)": the unique name of a variant of an effect.
std::string variant_name(const EffectVariant& variant);

/// Appends a parameter for each of the effect, named as "joint_harmonic(joint=2,order=2).cos", of
/// the group variant_name, nominal 0. Its scale is that at which the rms of the perturbation, or of
/// the largest of its perturbations, is a milliradian, a millimetre or a thousandth: about a
/// millimetre at the tip, as for the parameters of the arm. Only truncate_parameters removes an
/// effect again.
///
/// A parameter acts at its value whether it is free or not: to fix an effect, set its values as
/// nominal and leave them out of ArmResiduals::set_free.
/// \pre perturbations are as perturbations_of returns them, for the rows of the measurement
/// \return index of the first of them
int add_effect(ArmParameters& parameters, const EffectVariant& variant,
               std::vector<std::vector<Perturbation>> perturbations);

/// Keeps the first `count` parameters, and their perturbations.
void truncate_parameters(ArmParameters& parameters, std::size_t count);

/// Number of parameters before the first effect.
std::size_t geometry_parameters(const ArmParameters& parameters);

}  // namespace bathyal
