// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "bathyal/arm/arm.hpp"
#include "enum_names.hpp"

// Everything an arm is made of as plain Python (dict, list, str, float, arrays, Shape), for files
// and for pickle; and a chain of joint origins in the same form.

namespace bathyal::python {

const EnumNames<JointType>& type_names();

/// {"name", "source", "joints", "links", "root", "flange", "base", "tool"}
pybind11::dict arm_parts(const Arm& arm);

/// The arm of such a dict. Keys left out have the default of the C++ struct; a key that is not
/// known is refused.
Arm arm_from_parts(const pybind11::dict& parts);

/// Those functions and their like for chains, private to the package's file formats.
void bind_arm_parts(pybind11::module_& module);

}  // namespace bathyal::python
