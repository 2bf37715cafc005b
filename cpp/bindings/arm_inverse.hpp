// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "bathyal/arm/arm.hpp"

namespace bathyal::python {

/// The result's class; before the methods that return it.
void bind_inverse_result(pybind11::module_& module);

/// Arm.inverse
void add_inverse(pybind11::class_<Arm>& cls);

}  // namespace bathyal::python
