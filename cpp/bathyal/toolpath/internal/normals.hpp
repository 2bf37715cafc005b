// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/toolpath/internal/route.hpp"

namespace bathyal::toolpath {

/// Sets the normal and its standard deviation of every piece over the tool's footprint: the
/// vertices of the piece's sheet within `radius` [m] of its middle. With radius = 0, and where
/// fewer than six vertices or only vertices on a line lie in the footprint, the normal is the
/// facet's.
///
/// Footprint: heights z over a plane are fitted by least squares, z = c + g·x, first over the
/// facet's own plane and then over the fitted one until it turns no more; the normal is that of the
/// last fit. The sheet is walked from the piece's facet over shared vertices, so
/// that the ground across a narrow cleft or on the other side of a plate stays out; triangles that
/// look away from the facet (by more than 90°) are left out too. In a soup, whose triangles share
/// no vertices, every facet is by itself.
///
/// Standard deviation, the root mean square of the angle the true normal may lie off, to first
/// order in the slope: atan √tr Cov(g).
///  - Facet: g = Σ z_i ∇λ_i, |∇λ_i| = e_i / 2A (e_i the edge across from corner i, A the area), so
///    tr Cov(g) = Σ σ_i² (e_i / 2A)². A right isosceles facet of leg h has 2σ/h: for a sonar's 2 cm
///    at 5 cm spacing 0.8, which tilts a single facet by about 30° (32.5° on average).
///  - Footprint of n vertices: tr of the slope block of (XᵀX)⁻¹ XᵀΣX (XᵀX)⁻¹, which falls as 1/√n.
/// σ_i is the larger of the vertex attribute "uncertainty" [m] and the root mean square residual of
/// the fit, √(Σr²/(n − 3)), of the footprint or, for a facet, of the vertices of all triangles that
/// touch it: ground that is not flat at that scale counts as uncertain too. NaN where neither is
/// there. On a plane, whose soundings are unknown, 0.
void estimate_normals(Route& route, const Surface& surface, double radius, int num_threads);

}  // namespace bathyal::toolpath
