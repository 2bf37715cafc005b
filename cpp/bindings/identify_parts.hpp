// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "arrays.hpp"
#include "bathyal/effects/measurements.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"
#include "enum_names.hpp"

// Bindings of the room identify: its data and its results.

namespace bathyal::python {

/// "hayati" or "dh"
const EnumNames<Parametrization>& parametrization_names();

/// Touches and Tracked.
void bind_identify_data(py::module_& module);

/// Effect, FoundEffect and the library.
void bind_effects(py::module_& module);

/// Support and CorrectedArm.
void bind_corrected_arm(py::module_& module);

/// ArmFit and what it is made of.
void bind_identify_fit(py::module_& module);

}  // namespace bathyal::python
