// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.hpp"
#include "bathyal/geometry/rigid_body.hpp"

// Arguments and results that RigidBody and the rooms above share.

namespace bathyal::python {

/// (3, 3)
py::array to_numpy(const Eigen::Matrix3d& matrix);

/// Shapes are checked here, values by `RigidBody::check`. No inertia is zero.
RigidBody rigid_body_arguments(double mass, const py::object& center_of_mass,
                               const py::object& inertia, double volume,
                               const py::object& center_of_buoyancy);

}  // namespace bathyal::python
