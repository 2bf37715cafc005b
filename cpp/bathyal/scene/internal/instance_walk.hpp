// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/packet_walk.hpp"

// Rays against instances: a walk down the tree over their boxes in the world, and at each a walk
// down its mesh's own hierarchy with the rays in the mesh's frame. There t still counts metres of
// the world, so that what was met in one instance bounds the rays in the next.

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

/// The bound on the way of a lane's ray that its t gives, as cull_bound; below 0 where the ray is
/// at its end before it starts.
template <class D>
inline D bound_of(D t, double length, D start) {
  const D bound = t * length - start;
  const D padded = bound + (absolute_of(bound) * 0x1p-22 + start * kFarPad);
  return padded < 3e38 ? padded : D{} + 3e38;
}

/// Unit directions of the world's packet and their inverses: what each instance begins with.
template <class Simd>
struct Directions {
  double unit[3][Simd::kRays];
  double inverse[3][Simd::kRays];
};

/// The lanes of the world's packet in the frame of an instance.
template <class Simd>
inline void turn_rays(const InstanceFrame& frame, const Packet<Simd>& world,
                      const Directions<Simd>& directions, int first, Packet<Simd>& local,
                      RayRegister<typename Simd::D>& turned) {
  using D = typename Simd::D;
  RayRegister<D> ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.o[axis] = load_as<D>(world.o[axis] + first);
    ray.d[axis] = load_as<D>(world.d[axis] + first);
    ray.unit[axis] = load_as<D>(directions.unit[axis] + first);
  }
  move_back(frame, ray.o, turned.o);
  turn_back(frame, ray.d, turned.d);
  turn_back(frame, ray.unit, turned.unit);
  set_inverse(turned);
  for (int axis = 0; axis < 3; ++axis) store_as(local.o[axis] + first, turned.o[axis]);
  shear_rays(local, first, turned, frame.per_metre);
}

/// The same at the identity: what turn_rays comes to, without its divisions.
template <class Simd>
inline void copy_rays(const Packet<Simd>& world, const Directions<Simd>& directions, int first,
                      Packet<Simd>& local, RayRegister<typename Simd::D>& copied) {
  using D = typename Simd::D;
  for (int axis = 0; axis < 3; ++axis) {
    copied.o[axis] = load_as<D>(world.o[axis] + first);
    copied.unit[axis] = load_as<D>(directions.unit[axis] + first);
    copied.inverse[axis] = load_as<D>(directions.inverse[axis] + first);
    store_as(local.o[axis] + first, copied.o[axis]);
  }
  store_as(local.sx + first, load_as<D>(world.sx + first));
  store_as(local.sy + first, load_as<D>(world.sy + first));
  store_as(local.slope + first, load_as<D>(world.slope + first));
  store_as(local.kz + first, load_as<D>(world.kz + first));
}

/// Sets up `rays` of the world's packet in the frame of an instance; returns those that enter its
/// mesh's box before they end.
template <class Simd>
inline unsigned set_up_instance(const CastScene& mesh, const InstanceFrame& frame,
                                const Packet<Simd>& world, const Directions<Simd>& directions,
                                unsigned rays, Packet<Simd>& local) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  constexpr unsigned kRegister = (1U << Simd::kDoubles) - 1U;
  local.length = frame.per_metre;
  unsigned enter = 0;
  for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
    const unsigned part = rays >> first & kRegister;
    if (part == 0) continue;
    RayRegister<D> ray;
    if (frame.at_identity) {
      copy_rays(world, directions, first, local, ray);
    } else {
      turn_rays(frame, world, directions, first, local, ray);
    }
    const unsigned placed = enter_rays(mesh, local, first, ray, Simd::lanes(part));
    if (placed == 0) continue;
    const D t = load_as<D>(world.t + first);
    const D bound = bound_of(t, frame.per_metre, load_as<D>(local.start + first));
    store_as(local.t + first, t);
    store_as(local.primitive + first, I{} + static_cast<std::int64_t>(kNoPrimitive));
    Simd::store_narrow(local.bound + first, bound);
    enter |= (placed & Simd::bits(bound >= 0.0)) << first;
  }
  return enter;
}

/// Takes over what the rays met in an instance; of equal ranges the lowest row's.
template <class Simd>
inline void keep_nearer(const Packet<Simd>& local, unsigned rays, std::int32_t row,
                        Packet<Simd>& world) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  constexpr unsigned kRegister = (1U << Simd::kDoubles) - 1U;
  for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
    const unsigned part = rays >> first & kRegister;
    if (part == 0) continue;
    const I triangle = load_as<I>(local.primitive + first);
    const I met = Simd::lanes(part) & (triangle != static_cast<std::int64_t>(kNoPrimitive));
    if (Simd::bits(met) == 0) continue;
    const I key = triangle + key_of(row, 0);
    const I best_key = load_as<I>(world.primitive + first);
    const D t = load_as<D>(local.t + first);
    const D best_t = load_as<D>(world.t + first);
    const I take = met & ((t < best_t) | ((t == best_t) & (key < best_key)));
    const D new_t = take ? t : best_t;
    const D start = load_as<D>(world.start + first);
    store_as(world.t + first, new_t);
    store_as(world.u + first, take ? load_as<D>(local.u + first) : load_as<D>(world.u + first));
    store_as(world.v + first, take ? load_as<D>(local.v + first) : load_as<D>(world.v + first));
    store_as(world.primitive + first, take ? key : best_key);
    Simd::store_narrow(world.bound + first, bound_of(new_t, world.length, start));
  }
}

/// The packets of a batch of rays, and the rays that part in an instance.
template <class Simd>
struct InstancePackets {
  Packet<Simd> world;
  Directions<Simd> directions;
  Packet<Simd> local;
  Walkers<Simd> walkers;
};

template <class Simd>
inline void walk_mesh(const CastScene& mesh, Packet<Simd>& packet, unsigned rays,
                      Walkers<Simd>& walkers) {
  if (packet.mixed) {
    walk_packet<Simd, true>(mesh, packet, rays, walkers);
  } else {
    walk_packet<Simd, false>(mesh, packet, rays, walkers);
  }
  walkers.walk_all(mesh, packet);
}

/// The instance whose frame the tree is in: the world's packet walks its mesh as it is. There
/// primitives are triangles, so what was met in other rows is put away: 0 where it has the lower
/// row, which no tie beats, else none, which all do.
template <class Simd>
inline void visit_home(const InstancedScene& scene, unsigned rays, InstancePackets<Simd>& packets) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  constexpr auto kNone = static_cast<std::int64_t>(kNoPrimitive);
  const InstanceKey first_key = key_of(scene.home, 0);
  Packet<Simd>& world = packets.world;
  alignas(64) double t[Simd::kRays];
  alignas(64) std::int64_t keys[Simd::kRays];
  for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
    const I key = load_as<I>(world.primitive + first);
    store_as(keys + first, key);
    store_as(t + first, load_as<D>(world.t + first));
    store_as(world.primitive + first, key < first_key ? I{} : I{} + kNone);
  }
  walk_mesh(scene.meshes[scene.frames[scene.home].mesh], world, rays, packets.walkers);
  for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
    const D before = load_as<D>(t + first);
    const D now = load_as<D>(world.t + first);
    const I key = load_as<I>(keys + first);
    const I triangle = load_as<I>(world.primitive + first);
    const I tie = (now == before) & (key >= first_key) & (triangle != kNone);
    const I is_new = (now < before) | tie;
    store_as(world.primitive + first, is_new ? triangle + first_key : key);
  }
}

template <class Simd>
inline void visit_instance(const InstancedScene& scene, std::int32_t row, unsigned rays,
                           InstancePackets<Simd>& packets) {
  if (row == scene.home) return visit_home(scene, rays, packets);
  const InstanceFrame& frame = scene.frames[row];
  const CastScene& mesh = scene.meshes[frame.mesh];
  Packet<Simd>& local = packets.local;
  const unsigned enter =
      set_up_instance(mesh, frame, packets.world, packets.directions, rays, local);
  if (enter == 0) return;
  set_up_cull<Simd>(local);
  find_common<Simd>(local, enter);
  walk_mesh(mesh, local, enter, packets.walkers);
  keep_nearer(local, enter, row, packets.world);
}

/// One ray of the packet under one place of the tree over instances.
template <class Simd>
inline void walk_lane(const InstancedScene& scene, int lane, float near, std::uint32_t place,
                      InstancePackets<Simd>& packets) {
  const CullRay cull = cull_lane(packets.world, lane);
  Stack stack;
  stack.entry[stack.size++] = entry_of(near, place);
  while (stack.size > 0) {
    const std::uint64_t entry = stack.entry[--stack.size];
    if (t_of(entry) > packets.world.bound[lane]) continue;
    const auto at = static_cast<std::uint32_t>(entry);
    const std::int32_t child = scene.top.nodes[at / kWidth].child[at % kWidth];
    if (child < 0) {
      visit_instance(scene, ~child, 1U << lane, packets);
    } else {
      push_children<Simd>(cull, scene.top.nodes[child], static_cast<std::uint32_t>(child),
                          packets.world.bound[lane], stack);
    }
  }
}

/// As walk_packet, down the tree over instances.
template <class Simd, bool kMixed>
inline void walk_instances(const InstancedScene& scene, unsigned rays,
                           InstancePackets<Simd>& packets) {
  const Packet<Simd>& world = packets.world;
  PacketStack<Simd> stack;
  stack.size = 0;
  push_children<Simd, kMixed>(world, scene.top.nodes[0], 0, rays, stack);
  while (stack.size > 0) {
    const int top = --stack.size;
    const unsigned left = stack.rays[top] & Simd::at_least(Simd::load_rays(world.bound),
                                                           Simd::load_rays(stack.near[top]));
    if (left == 0) continue;
    const std::uint32_t place = stack.place[top];
    const std::int32_t child = scene.top.nodes[place / kWidth].child[place % kWidth];
    if (child < 0) {
      visit_instance(scene, ~child, left, packets);
    } else if (__builtin_popcount(left) > kFewRays<Simd>) {
      push_children<Simd, kMixed>(world, scene.top.nodes[child], static_cast<std::uint32_t>(child),
                                  left, stack);
    } else {
      for (unsigned rest = left; rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        walk_lane(scene, lane, stack.near[top][lane], place, packets);
      }
    }
  }
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
std::size_t cast_instances(const InstancedScene& scene, const RayBatch& batch, RayHit* hits) {
  InstancePackets<Simd> packets;
  __builtin_memset(&packets.local, 0, sizeof packets.local);
  Packet<Simd>& world = packets.world;
  const auto keep = [&packets](int first, const RayRegister<typename Simd::D>& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      store_as(packets.directions.unit[axis] + first, ray.unit[axis]);
      store_as(packets.directions.inverse[axis] + first, ray.inverse[axis]);
    }
  };
  for (std::size_t row = batch.begin; row < batch.end; row += Simd::kRays) {
    const std::size_t left = batch.end - row;
    const int count = left < Simd::kRays ? static_cast<int>(left) : Simd::kRays;
    const SetUp lanes = set_up<Simd>(scene.top, batch, row, count, world, keep);
    if (scene.top.nodes != nullptr && lanes.enter != 0) {
      if (world.mixed) {
        walk_instances<Simd, true>(scene, lanes.enter, packets);
      } else {
        walk_instances<Simd, false>(scene, lanes.enter, packets);
      }
    }
    for (int lane = 0; lane < count; ++lane) {
      const std::size_t at = row + static_cast<std::size_t>(lane);
      if ((lanes.suspect >> lane & 1U) == 0) {
        write_instance_hit(world.t[lane], world.u[lane], world.v[lane], world.primitive[lane],
                           hits[at]);
      } else if (!cast_one_instances<Simd>(
                     scene, batch.origins + static_cast<std::ptrdiff_t>(at) * batch.origin_step,
                     batch.directions + 3 * at, hits[at])) {
        return at;
      }
    }
  }
  return kNoRow;
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
