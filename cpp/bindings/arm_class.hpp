// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "bathyal/arm/arm.hpp"

// What each file of the room adds to the module and to the class Arm.

namespace bathyal::python {

/// Link and DhTable; before the class.
void bind_arm_tables(pybind11::module_& module);

/// Arm.from_dh, Arm.to_dh
void add_tables(pybind11::class_<Arm>& cls);

/// Arm.forward, .jacobian, .manipulability, .statics, .within_limits
void add_kinematics(pybind11::class_<Arm>& cls);

/// InverseResult; before the method that returns it.
void bind_inverse_result(pybind11::module_& module);

/// Arm.inverse
void add_inverse(pybind11::class_<Arm>& cls);

}  // namespace bathyal::python
