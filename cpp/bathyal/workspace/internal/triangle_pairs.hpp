// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "bathyal/workspace/internal/welded_mesh.hpp"

namespace bathyal::workspace {

/// Whether two closed triangles of one mesh meet other than by a corner or an edge that they share,
/// decided exactly. A triangle without area meets nothing.
bool intersect(const WeldedMesh& mesh, std::size_t first, std::size_t second);

/// All such pairs, lower number first, sorted. Pairs are sought in a tree of boxes: O(n log n) and
/// the pairs whose boxes meet.
std::vector<std::pair<std::int32_t, std::int32_t>> intersecting_pairs(const WeldedMesh& mesh,
                                                                      int num_threads);

}  // namespace bathyal::workspace
