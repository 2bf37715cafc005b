// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.hpp"
#include "bathyal/scene/scene.hpp"

// The generators' bindings are several files: bind_generate calls them in this order.

namespace bathyal::python {

void bind_seabed_model(py::module_& module);
void bind_pipeline(py::module_& module);
void bind_solids(py::module_& module);
void bind_fish_paths(py::module_& module);

/// (2,) finite numbers.
Eigen::Vector2d place_argument(std::string_view name, const py::object& object);

/// (K, 2) numbers, None for no row.
std::vector<Eigen::Vector2d> places_argument(std::string_view name, const py::object& object);

}  // namespace bathyal::python
