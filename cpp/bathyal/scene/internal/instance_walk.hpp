// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/instance_ray.hpp"
#include "bathyal/scene/internal/packet_walk.hpp"

// Packets of rays against instances, as instance_ray.hpp does it for one.

namespace bathyal::scene {
namespace {

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

}  // namespace
}  // namespace bathyal::scene
