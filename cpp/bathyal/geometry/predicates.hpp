// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

// Exact decisions about points of plane and space, on doubles taken as they are: survey coordinates
// of 10⁷ m need no origin subtracted. A floating-point filter decides what is clear, inline; what
// is not goes to integer arithmetic out of line. The sign is always that of the exact value.
//
// Range: |coordinate| ≤ kLargestCoordinate and finite, so that no product of the filter overflows
// and what underflows stays below its absolute margin. Outside it the result is undefined; the
// public functions above refuse such points.

namespace bathyal {

struct Point2 {
  double x;
  double y;

  friend bool operator==(const Point2&, const Point2&) = default;
};

struct Point3 {
  double x;
  double y;
  double z;

  friend bool operator==(const Point3&, const Point3&) = default;
};

/// Lexicographic order by x, then y.
inline bool before(const Point2& a, const Point2& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

inline constexpr double kLargestCoordinate = 1e75;

namespace exact {

int orient2d(const Point2& a, const Point2& b, const Point2& c);
int incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d);
int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The sign after the tie is broken: never 0 for four distinct points.
int perturbed_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d);

// Errors of the filters relative to the sum of the magnitudes (Shewchuk 1997, "ccwerrboundA",
// "iccerrboundA" and "o3derrboundA"), and what underflow can add to them within the range above.
inline constexpr double kUnit = 0x1.0p-53;
inline constexpr double kOrientError = (3.0 + 16.0 * kUnit) * kUnit;
inline constexpr double kIncircleError = (10.0 + 96.0 * kUnit) * kUnit;
inline constexpr double kOrient3dError = (7.0 + 56.0 * kUnit) * kUnit;
inline constexpr double kOrientUnderflow = 1e-300;
inline constexpr double kOrient3dUnderflow = 1e-240;
inline constexpr double kIncircleUnderflow = 1e-170;

}  // namespace exact

/// +1 when a, b, c turn counter-clockwise, −1 when clockwise, 0 when they lie on one line.
inline int orient2d(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  const double bound =
      exact::kOrientError * (std::fabs(left) + std::fabs(right)) + exact::kOrientUnderflow;
  if (!(std::fabs(det) > bound)) [[unlikely]]
    return exact::orient2d(a, b, c);
  return det > 0.0 ? 1 : -1;
}

/// The side of the plane through a, b, c on which d lies: +1 where a, b, c turn clockwise as seen
/// from d, −1 where they turn counter-clockwise, 0 where the four lie in one plane.
inline int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double adx = a.x - d.x, ady = a.y - d.y, adz = a.z - d.z;
  const double bdx = b.x - d.x, bdy = b.y - d.y, bdz = b.z - d.z;
  const double cdx = c.x - d.x, cdy = c.y - d.y, cdz = c.z - d.z;
  const double bc = bdx * cdy, cb = cdx * bdy;
  const double ca = cdx * ady, ac = adx * cdy;
  const double ab = adx * bdy, ba = bdx * ady;
  const double det = adz * (bc - cb) + bdz * (ca - ac) + cdz * (ab - ba);
  const double magnitudes = std::fabs(adz) * (std::fabs(bc) + std::fabs(cb)) +
                            std::fabs(bdz) * (std::fabs(ca) + std::fabs(ac)) +
                            std::fabs(cdz) * (std::fabs(ab) + std::fabs(ba));
  const double bound = exact::kOrient3dError * magnitudes + exact::kOrient3dUnderflow;
  if (!(std::fabs(det) > bound)) [[unlikely]]
    return exact::orient3d(a, b, c, d);
  return det > 0.0 ? 1 : -1;
}

namespace exact {

/// The determinant of the in-circle test and the error it may have. The error's sum of magnitudes
/// is bounded by products of squared lengths: |x₁ y₂| + |x₂ y₁| ≤ (|p₁|² + |p₂|²) / 2.
struct Incircle {
  double det;
  double bound;

  Incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    const double adx = a.x - d.x, ady = a.y - d.y;
    const double bdx = b.x - d.x, bdy = b.y - d.y;
    const double cdx = c.x - d.x, cdy = c.y - d.y;
    const double bc = bdx * cdy, cb = cdx * bdy;
    const double ca = cdx * ady, ac = adx * cdy;
    const double ab = adx * bdy, ba = bdx * ady;
    const double a_lift = adx * adx + ady * ady;
    const double b_lift = bdx * bdx + bdy * bdy;
    const double c_lift = cdx * cdx + cdy * cdy;
    det = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
    bound = kIncircleError * (a_lift * b_lift + c_lift * (a_lift + b_lift)) + kIncircleUnderflow;
  }
};

}  // namespace exact

/// Where d lies against the circle through a, b, c, which turn counter-clockwise: +1 inside, −1
/// outside, 0 on it. Clockwise a, b, c reverse the sign.
inline int incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const exact::Incircle test(a, b, c, d);
  if (!(std::fabs(test.det) > test.bound)) [[unlikely]]
    return exact::incircle(a, b, c, d);
  return test.det > 0.0 ? 1 : -1;
}

/// Whether d lies inside the circle through a, b, c (counter-clockwise), co-circular points decided
/// as if every point lay a little above the paraboloid z = x² + y², the lexicographically last by
/// far the most (Devillers, Teillaud 2003): the Delaunay triangulation of distinct points is then
/// unique. For four distinct points with a, b, c not on one line.
inline bool in_perturbed_circle(const Point2& a, const Point2& b, const Point2& c,
                                const Point2& d) {
  const exact::Incircle test(a, b, c, d);
  if (!(std::fabs(test.det) > test.bound)) [[unlikely]] {
    return exact::perturbed_incircle(a, b, c, d) > 0;
  }
  return test.det > 0.0;
}

}  // namespace bathyal
