// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/cast_kernel.hpp"
#include "bathyal/scene/internal/ray_triangle.hpp"

// One ray's walk down the hierarchy, written once over `Simd` (eight floats) and compiled for each
// instruction set. Everything in float rules out and never decides.
//
// Why that is safe. Let R be the reach of the scene and D the distance of the ray's origin, and
// e = 2⁻²⁴. The float ray starts where the ray enters the scene's box, so all its coordinates are
// within R and its length within 4 R. Rounding its start moves it by e R, rounding its direction by
// 4 e R at the far end; a slab's distance b/d − o/d adds at most 8 e R / |d|. A pad of 16 e R on
// each axis covers all of it, and 2⁻⁴⁸ D what the double decision itself may be off. The triangle
// test's u, v and det are sums of triple products of s = o − v0 (|s| ≤ 4 R), d and an edge; their
// errors stay below 128 e R times the longer edge.

namespace bathyal::scene {
namespace {

inline constexpr double kBoxPad = 0x1p-20;       ///< 16 · 2⁻²⁴, of the reach
inline constexpr double kTrianglePad = 0x1p-17;  ///< 128 · 2⁻²⁴, of the reach
inline constexpr double kFarthest = 1e25;        ///< origins further out meet nothing [m]
inline constexpr float kLeastSlope = 0x1p-28F;   ///< keeps 1/d finite; moves a ray by 4 R 2⁻²⁸

/// The ray in the local frame, in float, from where it enters the scene's box.
struct CullRay {
  float o[3];
  float d[3];
  float inverse[3];
  float near_shift[3];  ///< t of a near plane b ≥ b · inverse − near_shift
  float far_shift[3];   ///< t of a far plane b ≤ b · inverse − far_shift
  float triangle_pad;   ///< of a triangle with edges of a metre
  double start;         ///< distance of `o` along the ray [m]
  double length;        ///< way of this ray [m] for one unit of the exact ray's t
};

inline bool is_finite3(const double* p) {
  return p[0] - p[0] == 0.0 && p[1] - p[1] == 0.0 && p[2] - p[2] == 0.0;
}

inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }

/// Writes d / |d| and returns |d|, also where its square would leave double's range: it is then
/// scaled by a power of two first, which changes no digit. Returns 0 for a d
/// of zero or one that is not finite.
inline double normalise(const double* d, double* unit) {
  const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  if (square > 1e-200 && square < 1e200) {
    const double length = __builtin_sqrt(square);
    for (int axis = 0; axis < 3; ++axis) unit[axis] = d[axis] / length;
    return length;
  }
  const double most = larger(absolute(d[0]), larger(absolute(d[1]), absolute(d[2])));
  if (most == 0.0 || !(most - most == 0.0)) return 0.0;
  const int exponent = __builtin_ilogb(most);
  double scaled[3];
  for (int axis = 0; axis < 3; ++axis) scaled[axis] = __builtin_scalbn(d[axis], -exponent);
  return __builtin_scalbn(normalise(scaled, unit), exponent);
}

/// Sets up the float ray from `origin` along the unit vector `d`. False when it passes the scene's
/// box by.
inline bool enter(const CastScene& scene, const double* origin, const double* d, double length,
                  CullRay& cull) {
  double o[3];
  double distance = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    o[axis] = origin[axis] - scene.origin[axis];
    distance += absolute(o[axis]);
  }
  const double far = scene.far_pad * distance;
  if (!(distance < kFarthest)) return false;
  const double pad = kBoxPad * scene.reach + far;
  double start = 0.0;
  double end = __builtin_inf();
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / (absolute(d[axis]) > 1e-200 ? d[axis] : 1e-200);
    const double a = (scene.low[axis] - 2.0 * pad - o[axis]) * inverse;
    const double b = (scene.high[axis] + 2.0 * pad - o[axis]) * inverse;
    start = larger(start, smaller(a, b));
    end = smaller(end, larger(a, b));
  }
  if (!(start <= end)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    cull.o[axis] = static_cast<float>(o[axis] + start * d[axis]);
    const auto slope = static_cast<float>(d[axis]);
    const float at_least = slope < 0.0F ? -kLeastSlope : kLeastSlope;
    cull.d[axis] = __builtin_fabsf(slope) < kLeastSlope ? at_least : slope;
    cull.inverse[axis] = 1.0F / cull.d[axis];
    const float shift = cull.o[axis] * cull.inverse[axis];
    const float padding = static_cast<float>(pad) * __builtin_fabsf(cull.inverse[axis]);
    cull.near_shift[axis] = shift + padding;
    cull.far_shift[axis] = shift - padding;
  }
  cull.triangle_pad = static_cast<float>(kTrianglePad * scene.reach + 4.0 * far);
  cull.start = start;
  cull.length = length;
  return true;
}

/// Best hit so far, in the units of the exact ray.
struct Nearest {
  double t;  ///< also the bound: hits beyond it do not count
  double u;
  double v;
  std::uint32_t primitive;
};

/// A bound on the float ray's t that no hit at or before `t` exceeds.
inline float cull_bound(const CullRay& cull, double t) {
  const double bound = t * cull.length - cull.start;
  const double room = absolute(bound) * 0x1p-22 + cull.start * kFarPad;
  return static_cast<float>(smaller(bound + room, 3e38));
}

/// Where a mesh keeps the indices of a primitive's corners.
struct Indices {
  const std::int32_t* index;
  const double* vertices;
};

inline Indices indices_of(const CastScene& scene, std::uint32_t primitive) {
  const std::int32_t mesh =
      scene.mesh_count == 1 ? 0 : name_of(scene.meshes, scene.mesh_count, primitive).mesh;
  const MeshArrays& arrays = scene.meshes[mesh];
  return {arrays.triangles + 3 * static_cast<std::int64_t>(primitive - arrays.first_primitive),
          arrays.vertices};
}

/// Where it keeps the corners.
inline void corners_of(const CastScene& scene, std::uint32_t primitive, const double** corner) {
  const Indices from = indices_of(scene, primitive);
  for (int c = 0; c < 3; ++c) {
    corner[c] = from.vertices + 3 * static_cast<std::int64_t>(from.index[c]);
  }
}

/// Puts the double decision on one primitive.
inline void confirm(const CastScene& scene, const ExactRay& ray, std::uint32_t primitive,
                    Nearest& best) {
  const double* corner[3];
  corners_of(scene, primitive, corner);
  Meeting meeting;
  if (!meets(ray, corner[0], corner[1], corner[2], meeting) || !(meeting.t >= 0.0)) return;
  if (meeting.t < best.t || (meeting.t == best.t && primitive < best.primitive)) {
    best = {meeting.t, meeting.u, meeting.v, primitive};
  }
}

/// Three numbers of each lane.
template <class V>
struct Triple {
  V x, y, z;
};

/// The least of u, v and |det| − u − v in Möller and Trumbore's form, the sign of det taken out: no
/// less than −pad where the line may meet the triangle. Lanes are rays or triangles.
template <class Simd, class V>
inline V least_weight(Triple<V> o, Triple<V> d, Triple<V> v0, Triple<V> e1, Triple<V> e2) {
  const V px = Simd::subtract_product(Simd::multiply(d.y, e2.z), d.z, e2.y);
  const V py = Simd::subtract_product(Simd::multiply(d.z, e2.x), d.x, e2.z);
  const V pz = Simd::subtract_product(Simd::multiply(d.x, e2.y), d.y, e2.x);
  const V det = Simd::add_product(Simd::add_product(Simd::multiply(e1.x, px), e1.y, py), e1.z, pz);
  const V sx = Simd::subtract(o.x, v0.x);
  const V sy = Simd::subtract(o.y, v0.y);
  const V sz = Simd::subtract(o.z, v0.z);
  const V u = Simd::add_product(Simd::add_product(Simd::multiply(sx, px), sy, py), sz, pz);
  const V qx = Simd::subtract_product(Simd::multiply(sy, e1.z), sz, e1.y);
  const V qy = Simd::subtract_product(Simd::multiply(sz, e1.x), sx, e1.z);
  const V qz = Simd::subtract_product(Simd::multiply(sx, e1.y), sy, e1.x);
  const V v = Simd::add_product(Simd::add_product(Simd::multiply(d.x, qx), d.y, qy), d.z, qz);
  const V sign = Simd::sign_of(det);
  const V us = Simd::exclusive_or(u, sign);
  const V vs = Simd::exclusive_or(v, sign);
  const V slack = Simd::subtract(Simd::absolute(det), Simd::add(us, vs));
  return Simd::minimum(Simd::minimum(us, vs), slack);
}

/// Triangles of the block that the ray's line may meet, a bit each.
template <class Simd>
inline unsigned candidates(const CullRay& ray, const TriangleBlock& block, float edge) {
  using F = typename Simd::F;
  const auto all = [](const float* p) {
    return Triple<F>{Simd::all(p[0]), Simd::all(p[1]), Simd::all(p[2])};
  };
  const auto load = [](const float(*p)[kWidth]) {
    return Triple<F>{Simd::load(p[0]), Simd::load(p[1]), Simd::load(p[2])};
  };
  const F least =
      least_weight<Simd>(all(ray.o), all(ray.d), load(block.v0), load(block.e1), load(block.e2));
  return Simd::at_least(least, Simd::all(-ray.triangle_pad * edge));
}

/// Entries wait as (t, place) with t in the upper half: t ≥ 0, so whole numbers order them.
struct Stack {
  std::uint64_t entry[kStackSize];
  int size = 0;
};

/// A child's place: eight times its node plus its lane.
inline std::uint64_t entry_of(float t, std::uint32_t place) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, &t, sizeof bits);
  return static_cast<std::uint64_t>(bits) << 32U | place;
}

inline float t_of(std::uint64_t entry) {
  const auto bits = static_cast<std::uint32_t>(entry >> 32U);
  float t;
  __builtin_memcpy(&t, &bits, sizeof t);
  return t;
}

/// Puts the children that the ray may meet on the stack, the nearest on top.
template <class Simd>
inline void push_children(const CullRay& ray, const WideNode& node, std::uint32_t number,
                          float bound, Stack& stack) {
  using F = typename Simd::F;
  F near = Simd::all(0.0F);
  F far = Simd::all(bound);
  for (int axis = 0; axis < 3; ++axis) {
    const bool backward = ray.d[axis] < 0.0F;
    const F inverse = Simd::all(ray.inverse[axis]);
    const F low = Simd::load(backward ? node.high[axis] : node.low[axis]);
    const F high = Simd::load(backward ? node.low[axis] : node.high[axis]);
    near = Simd::maximum(Simd::product_minus(low, inverse, Simd::all(ray.near_shift[axis])), near);
    far = Simd::minimum(Simd::product_minus(high, inverse, Simd::all(ray.far_shift[axis])), far);
  }
  unsigned met = Simd::at_least(far, near);
  if (met == 0) return;
  alignas(32) float t[kWidth];
  Simd::store(t, near);
  const int bottom = stack.size;
  for (; met != 0; met &= met - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(met));
    const std::uint64_t entry = entry_of(t[lane], number * kWidth + lane);
    int place = stack.size++;
    for (; place > bottom && stack.entry[place - 1] < entry; --place) {
      stack.entry[place] = stack.entry[place - 1];
    }
    stack.entry[place] = entry;
  }
}

/// Nearest hit within best.t under what waits on the stack; with `kAny`, the first one found.
template <class Simd, bool kAny>
inline void walk(const CastScene& scene, const ExactRay& exact, const CullRay& cull, Stack& stack,
                 Nearest& best) {
  float bound = cull_bound(cull, best.t);
  while (stack.size > 0) {
    const std::uint64_t entry = stack.entry[--stack.size];
    if (t_of(entry) > bound) continue;
    const auto place = static_cast<std::uint32_t>(entry);
    const WideNode& node = scene.nodes[place / kWidth];
    const std::int32_t child = node.child[place % kWidth];
    if (child >= 0) {
      push_children<Simd>(cull, scene.nodes[child], static_cast<std::uint32_t>(child), bound,
                          stack);
      continue;
    }
    const TriangleBlock& block = scene.blocks[~child];
    unsigned met = candidates<Simd>(cull, block, node.edge[place % kWidth]);
    if (met == 0) continue;
    for (; met != 0; met &= met - 1) {
      confirm(scene, exact, block.primitive[__builtin_ctz(met)], best);
    }
    if (kAny && best.primitive != kNoPrimitive) return;
    bound = cull_bound(cull, best.t);
  }
}

/// The same under the root.
template <class Simd, bool kAny>
inline void walk_all(const CastScene& scene, const ExactRay& exact, const CullRay& cull,
                     Nearest& best) {
  Stack stack;
  push_children<Simd>(cull, scene.nodes[0], 0, cull_bound(cull, best.t), stack);
  walk<Simd, kAny>(scene, exact, cull, stack, best);
}

inline void write_hit(const CastScene& scene, const Nearest& best, RayHit& hit) {
  if (best.primitive == kNoPrimitive) {
    hit.range = __builtin_inf();
    hit.mesh = hit.triangle = -1;
    hit.u = hit.v = 0.0;
    return;
  }
  const PrimitiveName name = name_of(scene.meshes, scene.mesh_count, best.primitive);
  hit.range = best.t;
  hit.mesh = name.mesh;
  hit.triangle = name.triangle;
  hit.u = best.u;
  hit.v = best.v;
}

/// One ray on its own. False when it is not fine.
template <class Simd>
inline bool cast_one(const CastScene& scene, const double* origin, const double* direction,
                     RayHit& hit) {
  double unit[3];
  if (!is_finite3(origin) || !is_finite3(direction)) return false;
  if (normalise(direction, unit) == 0.0) return false;
  Nearest best = {__builtin_inf(), 0.0, 0.0, kNoPrimitive};
  CullRay cull;
  if (scene.nodes != nullptr && enter(scene, origin, unit, 1.0, cull)) {
    walk_all<Simd, false>(scene, exact_ray(origin, direction, unit), cull, best);
  }
  write_hit(scene, best, hit);
  return true;
}

template <class Simd>
std::size_t occluded(const CastScene& scene, const RayBatch& batch, std::uint8_t* blocked) {
  for (std::size_t row = batch.begin; row < batch.end; ++row) {
    const double* from = batch.origins + static_cast<std::ptrdiff_t>(row) * batch.origin_step;
    const double* to = batch.directions + 3 * row;
    if (!is_finite3(from) || !is_finite3(to)) return row;
    const double way[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    double unit[3];
    const double length = normalise(way, unit);
    Nearest best = {1.0, 0.0, 0.0, kNoPrimitive};
    CullRay cull;
    if (scene.nodes != nullptr && length > 0.0 && enter(scene, from, unit, length, cull)) {
      walk_all<Simd, true>(scene, exact_ray(from, way, way), cull, best);
    }
    blocked[row] = best.primitive != kNoPrimitive ? 1 : 0;
  }
  return kNoRow;
}

}  // namespace
}  // namespace bathyal::scene
