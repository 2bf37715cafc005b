// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/geometry/triangle_mesh.hpp"
#include "bathyal/scene/ray_hit.hpp"

namespace bathyal {

/// The paper's own way by name (Filaretov, Konoplin, Konoplin 2018, eq 5–9; Möller, Trumbore 1997):
/// every ray against every triangle, with what the printed form leaves out: t ≥ 0 and the nearest
/// hit, ties to the lowest triangle. Directions of any length but zero; range in metres; one origin
/// serves all. For study and comparison: it costs rays × triangles, and unlike Scene::cast it may
/// let a ray slip between triangles that share an edge.
/// \throw std::invalid_argument that names the first row at fault, or when the rows do not match.
std::vector<RayHit> intersect_moller_trumbore(const TriangleMesh& mesh, PointView origins,
                                              PointView directions, int num_threads = 0);

}  // namespace bathyal
