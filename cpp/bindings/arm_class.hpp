// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "arrays.hpp"
#include "bathyal/arm/arm.hpp"
#include "bathyal/arm/kinematics.hpp"
#include "enum_names.hpp"

// What each file of the room adds to the module and to the class Arm, and what several of them use.

namespace bathyal::python {

/// "world" or "tool"
const EnumNames<TipFrame>& tip_frame_names();

inline JointView view_of(const Rows& rows) {
  return {rows.table.data(), rows.table.rows(), rows.table.cols()};
}

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
