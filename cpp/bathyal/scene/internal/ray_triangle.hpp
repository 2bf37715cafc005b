// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The decision whether a ray meets a triangle, and where: in double, after Woop, Benthin, Wald
// (2013), "Watertight ray/triangle intersection". Included by kernels of every instruction set;
// nothing here is fused but what is fused by name, so that all of them come to the same bytes.

namespace bathyal::scene {
namespace {

/// A ray with what the test needs of it.
struct ExactRay {
  double o[3];
  int kx, ky, kz;  ///< kz: the largest component of the direction
  double sx, sy;   ///< shear that lays the ray along kz
  double slope;    ///< way along kz for one unit of t
};

/// t and the barycentric weights of corners 1 and 2.
struct Meeting {
  double t;
  double u;
  double v;
};

inline double absolute(double x) { return __builtin_fabs(x); }

/// A ray from `origin` along `direction` as given, so that no digit is lost to scaling; t counts in
/// lengths of `unit`, the same direction scaled in any way.
inline ExactRay exact_ray(const double* origin, const double* direction, const double* unit) {
  ExactRay ray;
  for (int axis = 0; axis < 3; ++axis) ray.o[axis] = origin[axis];
  const double x = absolute(direction[0]);
  const double y = absolute(direction[1]);
  const double z = absolute(direction[2]);
  ray.kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
  ray.kx = ray.kz == 2 ? 0 : ray.kz + 1;
  ray.ky = ray.kx == 2 ? 0 : ray.kx + 1;
  ray.sx = direction[ray.kx] / direction[ray.kz];
  ray.sy = direction[ray.ky] / direction[ray.kz];
  ray.slope = unit[ray.kz];
  return ray;
}

/// What is lost when a · b is rounded to `product`.
inline double product_error(double a, double b, double product) {
#if defined(__FMA__)
  return __builtin_fma(a, b, -product);
#else
  // Dekker (1971): the same number without a fused multiply-add.
  constexpr double kSplit = 134217729.0;  // 2^27 + 1
  const double a_big = kSplit * a;
  const double a_high = a_big - (a_big - a);
  const double a_low = a - a_high;
  const double b_big = kSplit * b;
  const double b_high = b_big - (b_big - b);
  const double b_low = b - b_high;
  return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
#endif
}

/// a d − b c to within two units in the last place (Cornea, Harrison, Tang 2002; bound by
/// Jeannerod 2016): so its sign is exact, and zero means zero. That is what makes the test
/// watertight: triangles on both sides of an edge see opposite signs, always.
inline double exact_cross(double a, double b, double c, double d) {
  const double ad = a * d;
  const double bc = b * c;
  return (ad - bc) + (product_error(a, d, ad) - product_error(b, c, bc));
}

/// A corner in the sheared frame: the ray runs along z from the origin.
struct Sheared {
  double x, y, z;
};

inline Sheared shear(const ExactRay& ray, const double* corner) {
  const double z = corner[ray.kz] - ray.o[ray.kz];
  return {(corner[ray.kx] - ray.o[ray.kx]) - ray.sx * z,
          (corner[ray.ky] - ray.o[ray.ky]) - ray.sy * z, z};
}

/// z where the ray crosses the edge p q, computed from the edge alone and the same for (q, p): all
/// triangles that share it give the same range, so that the tie goes to the lowest of them.
inline double z_on_edge(Sheared p, Sheared q) {
  const bool swap = q.x < p.x || (q.x == p.x && (q.y < p.y || (q.y == p.y && q.z < p.z)));
  if (swap) {
    const Sheared t = p;
    p = q;
    q = t;
  }
  const double dx = p.x - q.x;
  const double dy = p.y - q.y;
  const double s = absolute(dx) >= absolute(dy) ? p.x / dx : p.y / dy;
  return p.z + s * (q.z - p.z);
}

/// Whether the ray's line meets the triangle a b c, from either side, borders included. A line in
/// the plane of the triangle does not meet it (its neighbours' borders are met instead).
inline bool meets(const ExactRay& ray, const double* corner_a, const double* corner_b,
                  const double* corner_c, Meeting& meeting) {
  const Sheared a = shear(ray, corner_a);
  const Sheared b = shear(ray, corner_b);
  const Sheared c = shear(ray, corner_c);
  const double u = exact_cross(c.x, c.y, b.x, b.y);
  const double v = exact_cross(a.x, a.y, c.x, c.y);
  const double w = exact_cross(b.x, b.y, a.x, a.y);
  const bool any_negative = u < 0.0 || v < 0.0 || w < 0.0;
  const bool any_positive = u > 0.0 || v > 0.0 || w > 0.0;
  if (any_negative == any_positive) return false;  // both: outside; neither: seen edge-on
  const double sum = u + v + w;
  double z;
  if (u != 0.0 && v != 0.0 && w != 0.0) {
    z = (u * a.z + v * b.z + w * c.z) / sum;
  } else if (u == 0.0) {
    z = v == 0.0 ? c.z : w == 0.0 ? b.z : z_on_edge(b, c);
  } else if (v == 0.0) {
    z = w == 0.0 ? a.z : z_on_edge(c, a);
  } else {
    z = z_on_edge(a, b);
  }
  meeting.t = z / ray.slope + 0.0;  // + 0: never −0
  meeting.u = v / sum + 0.0;
  meeting.v = w / sum + 0.0;
  return true;
}

}  // namespace
}  // namespace bathyal::scene
