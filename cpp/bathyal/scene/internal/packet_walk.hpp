// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/interleave.hpp"

// A packet's walk down the hierarchy: neighbouring rays of a fan visit much the same boxes and
// triangles, so each is tested against all of them at once. Where the rays part, the rest of the
// packet goes on ray by ray, so rays without any order lose little.

namespace bathyal::scene {
namespace {

/// In a block: eight triangles at once for each ray, rather than all rays for each triangle.
inline constexpr int kFewRaysInBlock = 4;

/// Under a box: every ray goes on by itself.
template <class Simd>
inline constexpr int kFewRays = Simd::kRays / 4;

/// Places that wait, the nearest on top, with the rays that may meet them and from which t on.
template <class Simd>
struct PacketStack {
  alignas(64) float near[kStackSize][Simd::kRays];
  std::uint32_t place[kStackSize];
  unsigned rays[kStackSize];
  int size;
};

template <class Simd, bool kMixed>
inline void push_children(const Packet<Simd>& packet, const WideNode& node, std::uint32_t number,
                          unsigned rays, PacketStack<Simd>& stack) {
  using P = typename Simd::P;
  alignas(64) float near_of[kWidth][Simd::kRays];
  unsigned rays_of[kWidth];
  float t_of_first[kWidth];
  int order[kWidth];  // farthest first
  int count = 0;
  const int some_ray = __builtin_ctz(rays);
  const P bound = Simd::load_rays(packet.bound);
  for (int child = 0; child < kWidth && node.child[child] != kNoChild; ++child) {
    P near = Simd::all_rays(0.0F);
    P far = bound;
    for (int axis = 0; axis < 3; ++axis) {
      const P inverse = Simd::load_rays(packet.inverse[axis]);
      const P near_shift = Simd::load_rays(packet.near_shift[axis]);
      const P far_shift = Simd::load_rays(packet.far_shift[axis]);
      const P low = Simd::all_rays(node.low[axis][child]);
      const P high = Simd::all_rays(node.high[axis][child]);
      if constexpr (kMixed) {
        const P a = Simd::multiply(low, inverse);
        const P b = Simd::multiply(high, inverse);
        near = Simd::maximum(Simd::subtract(Simd::minimum(a, b), near_shift), near);
        far = Simd::minimum(Simd::subtract(Simd::maximum(a, b), far_shift), far);
      } else {
        const bool back = packet.backward[axis];
        near = Simd::maximum(Simd::product_minus(back ? high : low, inverse, near_shift), near);
        far = Simd::minimum(Simd::product_minus(back ? low : high, inverse, far_shift), far);
      }
    }
    const unsigned met = rays & Simd::at_least(far, near);
    if (met == 0) continue;
    Simd::store(near_of[child], near);
    rays_of[child] = met;
    t_of_first[child] = near_of[child][some_ray];
    int at = count++;
    for (; at > 0 && t_of_first[order[at - 1]] < t_of_first[child]; --at) order[at] = order[at - 1];
    order[at] = child;
  }
  for (int i = 0; i < count; ++i) {
    const int child = order[i];
    Simd::store(stack.near[stack.size], Simd::load_rays(near_of[child]));
    stack.place[stack.size] = number * kWidth + static_cast<unsigned>(child);
    stack.rays[stack.size] = rays_of[child];
    ++stack.size;
  }
}

/// a d − b c in every lane, as exact_cross.
template <class Simd, class D>
inline D exact_cross_of(D a, D b, D c, D d) {
  const D ad = a * d;
  const D bc = b * c;
  return (ad - bc) + (Simd::product_error(a, d, ad) - Simd::product_error(b, c, bc));
}

/// Puts the double decision on one primitive for one ray of the packet.
template <class Simd>
inline void confirm_lane(const CastScene& scene, Packet<Simd>& packet, int lane,
                         std::uint32_t primitive) {
  Nearest best = nearest_lane(packet, lane);
  confirm(scene, exact_lane(packet, lane), primitive, best);
  keep_lane(packet, lane, best, cull_bound(cull_lane(packet, lane), best.t));
}

/// A corner in the sheared frames of the rays.
template <class D>
struct ShearedRays {
  D x, y, z;
};

/// The lanes from `first` on that fill a register: confirm() with the same operations in the same
/// order. Rays through an edge or corner are rare and left to confirm_lane: their bits are
/// returned.
template <class Simd>
inline unsigned confirm_register(Packet<Simd>& packet, int first, unsigned rays,
                                 const double* const* corner, std::uint32_t primitive) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  const int kz = packet.common_kz;
  const int kx = kz == 2 ? 0 : kz + 1;
  const int ky = kx == 2 ? 0 : kx + 1;
  const D ox = load_as<D>(packet.o[kx] + first);
  const D oy = load_as<D>(packet.o[ky] + first);
  const D oz = load_as<D>(packet.o[kz] + first);
  const D sx = load_as<D>(packet.sx + first);
  const D sy = load_as<D>(packet.sy + first);
  const auto shear_of = [&](const double* p) {
    const D z = p[kz] - oz;
    return ShearedRays<D>{(p[kx] - ox) - sx * z, (p[ky] - oy) - sy * z, z};
  };
  const ShearedRays<D> a = shear_of(corner[0]);
  const ShearedRays<D> b = shear_of(corner[1]);
  const ShearedRays<D> c = shear_of(corner[2]);
  const D u = exact_cross_of<Simd>(c.x, c.y, b.x, b.y);
  const D v = exact_cross_of<Simd>(a.x, a.y, c.x, c.y);
  const D w = exact_cross_of<Simd>(b.x, b.y, a.x, a.y);
  const I negative = (u < 0.0) | (v < 0.0) | (w < 0.0);
  const I positive = (u > 0.0) | (v > 0.0) | (w > 0.0);
  const I inside = (negative ^ positive) & Simd::lanes(rays);
  if (Simd::bits(inside) == 0) return 0;
  const I border = (u == 0.0) | (v == 0.0) | (w == 0.0);

  const D sum = u + v + w;
  const D z = (u * a.z + v * b.z + w * c.z) / sum;
  const D t = z / load_as<D>(packet.slope + first) + 0.0;
  const D best_t = load_as<D>(packet.t + first);
  const I best_primitive = load_as<I>(packet.primitive + first);
  const auto number = static_cast<std::int64_t>(primitive);
  const I nearer = (t < best_t) | ((t == best_t) & (best_primitive > number));
  const I take = inside & ~border & (t >= 0.0) & nearer;
  if (Simd::bits(take) != 0) {
    const D new_t = take ? t : best_t;
    store_as(packet.t + first, new_t);
    store_as(packet.u + first, take ? v / sum + 0.0 : load_as<D>(packet.u + first));
    store_as(packet.v + first, take ? w / sum + 0.0 : load_as<D>(packet.v + first));
    store_as(packet.primitive + first, take ? I{} + number : best_primitive);
    const D start = load_as<D>(packet.start + first);
    const D bound = new_t * packet.length - start;  // as cull_bound
    const D padded = bound + (absolute_of(bound) * 0x1p-22 + start * kFarPad);
    Simd::store_narrow(packet.bound + first, padded < 3e38 ? padded : D{} + 3e38);
  }
  return Simd::bits(inside & border);
}

template <class Simd>
inline void confirm_rays(const CastScene& scene, Packet<Simd>& packet, unsigned rays,
                         std::uint32_t primitive) {
  unsigned one_by_one = rays;
  if (packet.common_kz >= 0) {
    const double* corner[3];
    corners_of(scene, primitive, corner);
    one_by_one = 0;
    constexpr unsigned kRegister = (1U << Simd::kDoubles) - 1U;
    for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
      const unsigned part = rays >> first & kRegister;
      if (part == 0) continue;
      one_by_one |= confirm_register<Simd>(packet, first, part, corner, primitive) << first;
    }
  }
  for (; one_by_one != 0; one_by_one &= one_by_one - 1) {
    confirm_lane<Simd>(scene, packet, __builtin_ctz(one_by_one), primitive);
  }
}

/// One triangle of a block against all rays.
template <class Simd>
inline unsigned rays_near(const Packet<Simd>& packet, const TriangleBlock& block, int triangle,
                          float edge) {
  using P = typename Simd::P;
  const auto all = [triangle](const float(*p)[kWidth]) {
    return Triple<P>{Simd::all_rays(p[0][triangle]), Simd::all_rays(p[1][triangle]),
                     Simd::all_rays(p[2][triangle])};
  };
  const auto load = [](const float(*p)[Simd::kRays]) {
    return Triple<P>{Simd::load_rays(p[0]), Simd::load_rays(p[1]), Simd::load_rays(p[2])};
  };
  const P least = least_weight<Simd>(load(packet.cull_o), load(packet.cull_d), all(block.v0),
                                     all(block.e1), all(block.e2));
  return Simd::at_least(
      least, Simd::multiply(Simd::load_rays(packet.triangle_pad), Simd::all_rays(-edge)));
}

template <class Simd>
inline void visit_block(const CastScene& scene, Packet<Simd>& packet, const TriangleBlock& block,
                        float edge, unsigned rays) {
  if (__builtin_popcount(rays) <= kFewRaysInBlock) {
    for (; rays != 0; rays &= rays - 1) {
      const int lane = __builtin_ctz(rays);
      unsigned met = candidates<Simd>(cull_lane(packet, lane), block, edge);
      for (; met != 0; met &= met - 1) {
        confirm_lane<Simd>(scene, packet, lane, block.primitive[__builtin_ctz(met)]);
      }
    }
    return;
  }
  for (int triangle = 0; triangle < kWidth; ++triangle) {
    if (block.primitive[triangle] == kNoPrimitive) break;
    const unsigned met = rays & rays_near<Simd>(packet, block, triangle, edge);
    if (met != 0) confirm_rays<Simd>(scene, packet, met, block.primitive[triangle]);
  }
}

template <class Simd, bool kMixed>
inline void walk_packet(const CastScene& scene, Packet<Simd>& packet, unsigned rays,
                        Walkers<Simd>& walkers) {
  PacketStack<Simd> stack;
  stack.size = 0;
  push_children<Simd, kMixed>(packet, scene.nodes[0], 0, rays, stack);
  while (stack.size > 0) {
    const int top = --stack.size;
    const unsigned left = stack.rays[top] & Simd::at_least(Simd::load_rays(packet.bound),
                                                           Simd::load_rays(stack.near[top]));
    if (left == 0) continue;
    const std::uint32_t place = stack.place[top];
    const WideNode& node = scene.nodes[place / kWidth];
    const std::int32_t child = node.child[place % kWidth];
    if (child < 0) {
      visit_block<Simd>(scene, packet, scene.blocks[~child], node.edge[place % kWidth], left);
    } else if (__builtin_popcount(left) > kFewRays<Simd>) {
      push_children<Simd, kMixed>(packet, scene.nodes[child], static_cast<std::uint32_t>(child),
                                  left, stack);
    } else {
      for (unsigned rest = left; rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        walkers.leave(lane, stack.near[top][lane], place);
      }
    }
  }
}

template <class Simd>
std::size_t cast(const CastScene& scene, const RayBatch& batch, RayHit* hits) {
  Packet<Simd> packet;
  Walkers<Simd> walkers;
  for (std::size_t row = batch.begin; row < batch.end; row += Simd::kRays) {
    const std::size_t left = batch.end - row;
    const int count = left < Simd::kRays ? static_cast<int>(left) : Simd::kRays;
    const SetUp lanes = set_up<Simd>(scene, batch, row, count, packet,
                                     [](int, const RayRegister<typename Simd::D>&) {});
    if (scene.nodes != nullptr && lanes.enter != 0) {
      if (packet.mixed) {
        walk_packet<Simd, true>(scene, packet, lanes.enter, walkers);
      } else {
        walk_packet<Simd, false>(scene, packet, lanes.enter, walkers);
      }
      walkers.walk_all(scene, packet);
    }
    for (int lane = 0; lane < count; ++lane) {
      const std::size_t at = row + static_cast<std::size_t>(lane);
      if ((lanes.suspect >> lane & 1U) == 0) {
        write_hit(scene, nearest_lane(packet, lane), hits[at]);
      } else if (!cast_one<Simd>(
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
