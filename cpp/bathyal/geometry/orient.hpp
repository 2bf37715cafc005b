// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// Turns triangles so that two sharing an edge run along it in opposite directions, piece by piece,
/// breadth first from the piece's lowest triangle; across edges of three triangles or more nothing
/// is passed on. A surface with one side only (a Möbius strip) keeps edges that disagree. Then each
/// piece is turned as a whole: one whose area vectors cancel to a tenth (closed, or nearly)
/// outward, any other to face up on balance (sum of area vectors with z ≥ 0). `triangles` must
/// index `points`, each with three different vertices.
void orient(PointView points, TriangleMatrix& triangles);

}  // namespace bathyal
