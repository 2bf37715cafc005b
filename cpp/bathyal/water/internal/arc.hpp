// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "bathyal/water/sound_path.hpp"

namespace bathyal {

/// sinh(x) / x, 1 at 0.
inline double sinh_ratio(double x) { return x == 0.0 ? 1.0 : std::sinh(x) / x; }

/// ln(1 + x) / x, 1 at 0.
inline double log1p_ratio(double x) { return x == 0.0 ? 1.0 : std::log1p(x) / x; }

/// artanh(x) / x, 1 at 0.
inline double atanh_ratio(double x) { return x == 0.0 ? 1.0 : std::atanh(x) / x; }

/// Time from a state until a depth and the sine of the angle there, on one arc that does not turn
/// before; nothing where it turns before, or where the depth lies behind.
struct ArcEnd {
  double time = 0.0;
  double down = 0.0;
};

inline std::optional<ArcEnd> arc_to_depth(const SoundState& from, double gradient, double depth) {
  const bool goes_down = from.down > 0.0 || (from.down == 0.0 && gradient < 0.0);
  const double sign =
      goes_down ? 1.0 : -1.0;  // an upward ray is the mirror image of a downward one
  const double way = sign * (depth - from.depth);
  const double s1 = sign * from.down;
  if (!(way >= 0.0) || std::isinf(way)) return std::nullopt;
  if (way == 0.0) return ArcEnd{0.0, from.down};
  const double growth = sign * gradient * way / from.speed;  // c₂ / c₁ − 1
  const double k2 = from.along * from.along;
  const double squared = s1 * s1 - k2 * growth * (2.0 + growth);
  if (squared < 0.0 || !(growth > -1.0)) return std::nullopt;
  const double s2 = std::sqrt(squared);
  if (s1 + s2 == 0.0) return std::nullopt;
  // t = ln((1 + growth) (1 + s₁) / (1 + s₂)) / g, without the division of two small numbers.
  const double q = k2 * growth * (2.0 + growth) / ((s1 + s2) * (1.0 + s2));
  const double slope = k2 * (2.0 + growth) / ((s1 + s2) * (1.0 + s2));
  const double time = way / from.speed * (log1p_ratio(growth) + log1p_ratio(q) * slope);
  return ArcEnd{time, sign * s2};
}

/// The state at a horizontal distance that the arc reaches.
inline SoundState arc_to_distance(const SoundState& from, double gradient, double distance) {
  const double way = distance - from.distance;
  if (way == 0.0) return from;
  const double invariant = from.along / from.speed;  // p of Snell's law
  const double s1 = from.down;
  const double s2 = std::clamp(s1 - invariant * gradient * way, -1.0, 1.0);
  const double k1 = from.along;
  const double k2 = std::sqrt((1.0 - s2) * (1.0 + s2));
  SoundState to;
  to.distance = distance;
  to.depth = from.depth + way * (s1 + s2) / (k1 + k2);
  to.along = k2;
  to.down = s2;
  to.speed = from.speed * k2 / k1;
  // tanh(g t) = (s₁ − s₂) / (1 − s₁ s₂), and 1 − s₁ s₂ = ½ ((s₁ − s₂)² + cos²θ₁ + cos²θ₂).
  const double rest = 0.5 * ((s1 - s2) * (s1 - s2) + k1 * k1 + k2 * k2);
  to.time = from.time + invariant * way / rest * atanh_ratio(invariant * gradient * way / rest);
  return to;
}

}  // namespace bathyal
