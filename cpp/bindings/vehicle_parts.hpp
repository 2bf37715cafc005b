// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "arrays.hpp"
#include "bathyal/vehicle/simulate.hpp"
#include "typing.hpp"

// Arguments that motions of vehicles, with and without an arm, share.

namespace bathyal::python {

using StateLike = py::typing::Union<ArrayLike, py::typing::Tuple<ArrayLike, ArrayLike>>;
using ThrustLike =
    py::typing::Union<ArrayLike, py::typing::Callable<ArrayLike(py::float_, py::array, py::array)>>;

/// Of shape (6,), finite.
Vec6 vec6_argument(std::string_view name, const py::object& object);
py::array vec6_to_numpy(const Vec6& values);

py::array poses_to_numpy(const VehicleMotionRecord& motion);       ///< (K, 4, 4)
py::array velocities_to_numpy(const VehicleMotionRecord& motion);  ///< (K, 6)

/// A pose at rest, or (pose, velocity).
VehicleState state_argument(const py::object& object);

/// A constant, or what a function gives, which is called with the interpreter's lock held.
WrenchFunction wrench_argument(const py::object& object);

}  // namespace bathyal::python
