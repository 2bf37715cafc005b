// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/triangle_mesh.hpp"

namespace bathyal::geometry {

/// Area of the mesh's shadow on the horizontal plane, every place counted once [m²].
double shadow_area(const TriangleMesh& mesh, int num_threads);

}  // namespace bathyal::geometry
