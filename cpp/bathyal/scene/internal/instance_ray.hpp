// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/ray_walk.hpp"

// One ray against instances: a walk down the tree over their boxes in the world, and at each a walk
// down its mesh's own hierarchy with the ray in the mesh's frame. There t still counts metres of
// the world, so that what was met in one instance bounds the ray in the next.

namespace bathyal::scene {
namespace {

/// rotationᵀ · v; the same operations in the same order for one ray and for a register of them.
template <class V>
inline void turn_back(const InstanceFrame& frame, const V* v, V* turned) {
  for (int axis = 0; axis < 3; ++axis) {
    turned[axis] = frame.rotation[0][axis] * v[0] + frame.rotation[1][axis] * v[1] +
                   frame.rotation[2][axis] * v[2];
  }
}

/// An origin in the mesh's frame.
template <class V>
inline void move_back(const InstanceFrame& frame, const V* o, V* moved) {
  V from[3];
  for (int axis = 0; axis < 3; ++axis) from[axis] = o[axis] - frame.position[axis];
  turn_back(frame, from, moved);
  for (int axis = 0; axis < 3; ++axis) moved[axis] = frame.per_metre * moved[axis];
}

/// The nearest hit of a ray on its own, with the row in its name.
struct NearestInstance {
  Nearest found;
  InstanceKey key;
};

/// One ray against one instance, within best.found.t. `direction` is as given; t counts in lengths
/// of `unit`, a vector along it.
template <class Simd, bool kAny>
inline void visit_instance(const InstancedScene& scene, std::int32_t row, const double* origin,
                           const double* direction, const double* unit, NearestInstance& best) {
  const InstanceFrame& frame = scene.frames[row];
  const CastScene& mesh = scene.meshes[frame.mesh];
  double o[3], d[3], way[3], along[3], cull_along[3];
  move_back(frame, origin, o);
  turn_back(frame, direction, d);
  turn_back(frame, unit, way);
  const double length = normalise(way, cull_along);
  if (length == 0.0) return;
  for (int axis = 0; axis < 3; ++axis) along[axis] = way[axis] * frame.per_metre;
  CullRay cull;
  if (!enter(mesh, o, cull_along, length * frame.per_metre, cull)) return;
  Nearest found = {best.found.t, 0.0, 0.0, kNoPrimitive};
  walk_all<Simd, kAny>(mesh, exact_ray(o, d, along), cull, found);
  if (found.primitive == kNoPrimitive) return;
  const InstanceKey key = key_of(row, found.primitive);
  if (found.t < best.found.t || (found.t == best.found.t && key < best.key)) best = {found, key};
}

/// One ray against all instances, or with `kAny` until one is met.
template <class Simd, bool kAny>
inline void walk_all_instances(const InstancedScene& scene, const CullRay& cull,
                               const double* origin, const double* direction, const double* unit,
                               NearestInstance& best) {
  Stack stack;
  push_children<Simd>(cull, scene.top.nodes[0], 0, cull_bound(cull, best.found.t), stack);
  while (stack.size > 0) {
    const std::uint64_t entry = stack.entry[--stack.size];
    const float bound = cull_bound(cull, best.found.t);
    if (t_of(entry) > bound) continue;
    const auto place = static_cast<std::uint32_t>(entry);
    const std::int32_t child = scene.top.nodes[place / kWidth].child[place % kWidth];
    if (child < 0) {
      visit_instance<Simd, kAny>(scene, ~child, origin, direction, unit, best);
      if (kAny && best.found.primitive != kNoPrimitive) return;
    } else {
      push_children<Simd>(cull, scene.top.nodes[child], static_cast<std::uint32_t>(child), bound,
                          stack);
    }
  }
}

inline void write_instance_hit(double t, double u, double v, InstanceKey key, RayHit& hit) {
  if (!(t < __builtin_inf())) {
    hit.range = __builtin_inf();
    hit.mesh = hit.triangle = -1;
    hit.u = hit.v = 0.0;
    return;
  }
  hit.range = t;
  hit.mesh = static_cast<std::int32_t>(key >> 32);
  hit.triangle = static_cast<std::int32_t>(key & 0xffffffff);
  hit.u = u;
  hit.v = v;
}

/// As cast_one. The direction is scaled by a power of two first: its length may be one that sums of
/// products leave double's range with.
template <class Simd>
inline bool cast_one_instances(const InstancedScene& scene, const double* origin,
                               const double* direction, RayHit& hit) {
  double unit[3];
  if (!is_finite3(origin) || !is_finite3(direction)) return false;
  if (normalise(direction, unit) == 0.0) return false;
  const double most =
      larger(absolute(direction[0]), larger(absolute(direction[1]), absolute(direction[2])));
  double scaled[3];
  for (int axis = 0; axis < 3; ++axis) {
    scaled[axis] = __builtin_scalbn(direction[axis], -__builtin_ilogb(most));
  }
  NearestInstance best = {{__builtin_inf(), 0.0, 0.0, kNoPrimitive}, 0};
  CullRay cull;
  if (scene.top.nodes != nullptr && enter(scene.top, origin, unit, 1.0, cull)) {
    walk_all_instances<Simd, false>(scene, cull, origin, scaled, unit, best);
  }
  write_instance_hit(best.found.t, best.found.u, best.found.v, best.key, hit);
  return true;
}

template <class Simd>
std::size_t occluded_instances(const InstancedScene& scene, const RayBatch& batch,
                               std::uint8_t* blocked) {
  for (std::size_t row = batch.begin; row < batch.end; ++row) {
    const double* from = batch.origins + static_cast<std::ptrdiff_t>(row) * batch.origin_step;
    const double* to = batch.directions + 3 * row;
    if (!is_finite3(from) || !is_finite3(to)) return row;
    const double way[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    double unit[3];
    const double length = normalise(way, unit);
    NearestInstance best = {{1.0, 0.0, 0.0, kNoPrimitive}, 0};
    CullRay cull;
    if (scene.top.nodes != nullptr && length > 0.0 && enter(scene.top, from, unit, length, cull)) {
      walk_all_instances<Simd, true>(scene, cull, from, way, way, best);
    }
    blocked[row] = best.found.primitive != kNoPrimitive ? 1 : 0;
  }
  return kNoRow;
}

}  // namespace
}  // namespace bathyal::scene
