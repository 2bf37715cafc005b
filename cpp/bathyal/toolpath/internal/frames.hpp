// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/toolpath/internal/route.hpp"
#include "bathyal/toolpath/toolpath.hpp"

namespace bathyal::toolpath {

/// [n, −b, −a] with n the part of `direction` perpendicular to `approach`; where there is none, the
/// part of `fallback`, and where that has none either of the world's x or y.
Eigen::Matrix3d tool_frame(const Vec3& approach, const Vec3& direction, const Vec3& fallback);

/// The paper's form: samples at both ends of every piece with the piece's own frame; where two
/// pieces of one facet go on straight the shared end appears once. Fills every array of the path up
/// to the gap flag and normal_std; the position is still on the bottom.
ToolPath sample_piecewise_constant(const Route& route, double step);

/// Frames blended over `blend_length`. At arc length s each turn φ_k (a rotation vector in the
/// world, at s_k) has happened to the part w((s − s_k) / blend_length + ½), w(x) = 3x² − 2x³, and
/// R(s) = … exp(w₂ φ₂) exp(w₁ φ₁) R₀: the cumulative form of Kim, Kim, Shin (1995), never
/// undefined, not even for a return on the same line. Turns that overlap do not commute; halfway
/// between the product built up from behind and that built back from ahead, the reversed path has
/// the same frames. Samples: the ends of pieces, within turns points no further apart than an
/// eighth of blend_length, and those that `step` requires.
ToolPath sample_blended(const Route& route, double blend_length, double step);

/// The smallest angle that turns one frame into the other [rad].
double turn_between(const ToolPath& path, std::size_t i, std::size_t j);

}  // namespace bathyal::toolpath
