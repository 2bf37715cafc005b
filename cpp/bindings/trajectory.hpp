// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.hpp"
#include "bathyal/geometry/trajectory.hpp"

namespace bathyal::python {

/// (4, 4), a Trajectory, or a function of the time in seconds that gives a (4, 4).
using PoseLike = py::typing::Optional<
    py::typing::Union<Trajectory, ArrayLike, py::typing::Callable<ArrayLike(py::float_)>>>;

/// None is the identity. A function is called every 0.05 s from 0 to 600 s.
Trajectory trajectory_argument(std::string_view name, const py::object& object);

}  // namespace bathyal::python
