// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "bathyal/scene/scene.hpp"

namespace bathyal::python {

/// Hits, intersect_moller_trumbore: what rays give back and what needs no scene.
void bind_hits(pybind11::module_& module);

/// Scene.cast and Scene.occluded.
void bind_rays(pybind11::class_<Scene>& scene);

}  // namespace bathyal::python
