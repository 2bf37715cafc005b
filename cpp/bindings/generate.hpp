// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.hpp"
#include "bathyal/scene/scene.hpp"

// The generators' bindings are several files: bind_generate calls them in this order.

namespace bathyal::python {

void bind_seabed_model(py::module_& module);

/// (2,) finite numbers.
Eigen::Vector2d place_argument(std::string_view name, const py::object& object);

}  // namespace bathyal::python
