// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/ray_walk.hpp"

// Rays taken together: Simd::kRays of them, their numbers side by side. Setting rays up costs more
// divisions than finding what they meet, so it is done for a whole register of doubles at once.

namespace bathyal::scene {
namespace {

/// The rays of a packet, as ExactRay, CullRay and Nearest have them, a lane each.
template <class Simd>
struct alignas(64) Packet {
  static constexpr int kRays = Simd::kRays;

  double o[3][kRays];
  double d[3][kRays];  ///< as given
  double sx[kRays];
  double sy[kRays];
  double slope[kRays];
  double start[kRays];
  std::int64_t kz[kRays];

  float cull_o[3][kRays];
  float cull_d[3][kRays];
  float inverse[3][kRays];
  float near_shift[3][kRays];
  float far_shift[3][kRays];
  float box_pad[kRays];
  float triangle_pad[kRays];

  double t[kRays];
  double u[kRays];
  double v[kRays];
  std::int64_t primitive[kRays];
  float bound[kRays];

  double length;     ///< way of the rays in their frame [m] for one unit of t
  int common_kz;     ///< kz of all rays that enter, −1 where they differ
  bool backward[3];  ///< which way they go along each axis
  bool mixed;        ///< they do not all go the same way along every axis
};

template <class V>
inline V load_as(const void* p) {
  V v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

template <class V>
inline void store_as(void* p, V v) {
  __builtin_memcpy(p, &v, sizeof v);
}

template <class D>
inline D absolute_of(D x) {
  return x < 0.0 ? -x : x;
}

/// Lanes of a packet, a bit each.
struct SetUp {
  unsigned enter = 0;    ///< rays that enter the scene's box
  unsigned suspect = 0;  ///< rays that are not fine, or whose length needs care
};

/// Some lanes of a ray in double.
template <class D>
struct RayRegister {
  D o[3];
  D d[3];
  D unit[3];
  D inverse[3];  ///< 1 / unit, finite
};

/// What the double decision takes of the lanes' directions, where one unit of t is `length` [m] of
/// way in the packet's frame.
template <class Simd>
inline void shear_rays(Packet<Simd>& packet, int first, const RayRegister<typename Simd::D>& ray,
                       double length) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  const D x = absolute_of(ray.d[0]);
  const D y = absolute_of(ray.d[1]);
  const D z = absolute_of(ray.d[2]);
  const I z_over_x = ~(x > z);
  const I z_over_y = ~(y > z);
  const I along_x = (x > y) & ~z_over_x;
  const I along_y = ~(x > y) & ~z_over_y;
  const D major = along_x ? ray.d[0] : along_y ? ray.d[1] : ray.d[2];
  store_as(packet.sx + first, (along_x ? ray.d[1] : along_y ? ray.d[2] : ray.d[0]) / major);
  store_as(packet.sy + first, (along_x ? ray.d[2] : along_y ? ray.d[0] : ray.d[1]) / major);
  const D slope = along_x ? ray.unit[0] : along_y ? ray.unit[1] : ray.unit[2];
  store_as(packet.slope + first, slope * length);
  store_as(packet.kz + first, along_x ? I{} : along_y ? I{} + 1 : I{} + 2);
}

template <class D>
inline void set_inverse(RayRegister<D>& ray) {
  for (int axis = 0; axis < 3; ++axis) {
    const D unit = ray.unit[axis];
    ray.inverse[axis] = 1.0 / (absolute_of(unit) > 1e-200 ? unit : D{} + 1e-200);
  }
}

/// Whether the lanes, sheared already, enter the scene's box: as enter() does for one ray. A bit
/// for each of those that are `fine`.
template <class Simd>
inline unsigned enter_rays(const CastScene& scene, Packet<Simd>& packet, int first,
                           const RayRegister<typename Simd::D>& ray, typename Simd::I fine) {
  using D = typename Simd::D;
  D o[3];
  D distance = D{};
  for (int axis = 0; axis < 3; ++axis) {
    o[axis] = ray.o[axis] - scene.origin[axis];
    distance = distance + absolute_of(o[axis]);
  }
  const D far = scene.far_pad * distance;
  const D pad = kBoxPad * scene.reach + far;
  D start = D{};
  D end = D{} + __builtin_inf();
  for (int axis = 0; axis < 3; ++axis) {
    const D a = (scene.low[axis] - 2.0 * pad - o[axis]) * ray.inverse[axis];
    const D b = (scene.high[axis] + 2.0 * pad - o[axis]) * ray.inverse[axis];
    const D least = a < b ? a : b;
    const D most = a < b ? b : a;
    start = start > least ? start : least;
    end = end < most ? end : most;
  }
  store_as(packet.start + first, start);
  for (int axis = 0; axis < 3; ++axis) {
    Simd::store_narrow(packet.cull_o[axis] + first, o[axis] + start * ray.unit[axis]);
    Simd::store_narrow(packet.cull_d[axis] + first, ray.unit[axis]);
  }
  Simd::store_narrow(packet.box_pad + first, pad);
  Simd::store_narrow(packet.triangle_pad + first, kTrianglePad * scene.reach + 4.0 * far);
  return Simd::bits(fine & (start <= end) & (distance < kFarthest));
}

/// The double half of setting up, for the lanes from `first` on that fill a register, of which
/// `keep(first, ray)` may take what it wants.
template <class Simd, class Keep>
inline SetUp set_up_exact(const CastScene& scene, Packet<Simd>& packet, int first,
                          const Keep& keep) {
  using D = typename Simd::D;
  using I = typename Simd::I;
  RayRegister<D> ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.o[axis] = load_as<D>(packet.o[axis] + first);
    ray.d[axis] = load_as<D>(packet.d[axis] + first);
  }
  const D square = ray.d[0] * ray.d[0] + ray.d[1] * ray.d[1] + ray.d[2] * ray.d[2];
  // Finite for all origins but absurd ones, which are suspect.
  const D sum = ray.o[0] + ray.o[1] + ray.o[2];
  const I fine = (square > 1e-200) & (square < 1e200) & (sum - sum == 0.0);
  const D length = Simd::root(square);
  for (int axis = 0; axis < 3; ++axis) ray.unit[axis] = ray.d[axis] / length;
  set_inverse(ray);
  keep(first, ray);
  shear_rays(packet, first, ray, 1.0);
  return {enter_rays(scene, packet, first, ray, fine), Simd::bits(~fine)};
}

/// The float half, for all lanes.
template <class Simd>
inline void set_up_cull(Packet<Simd>& packet) {
  using P = typename Simd::P;
  const P pad = Simd::load_rays(packet.box_pad);
  for (int axis = 0; axis < 3; ++axis) {
    const P slope = Simd::load_rays(packet.cull_d[axis]);
    const P steep = Simd::maximum(Simd::absolute(slope), Simd::all_rays(kLeastSlope));
    const P d = Simd::exclusive_or(steep, Simd::sign_of(slope));
    const P inverse = Simd::divide(Simd::all_rays(1.0F), d);
    const P shift = Simd::multiply(Simd::load_rays(packet.cull_o[axis]), inverse);
    const P padding = Simd::multiply(pad, Simd::absolute(inverse));
    Simd::store(packet.cull_d[axis], d);
    Simd::store(packet.inverse[axis], inverse);
    Simd::store(packet.near_shift[axis], Simd::add(shift, padding));
    Simd::store(packet.far_shift[axis], Simd::subtract(shift, padding));
  }
}

/// What the rays that enter have in common.
template <class Simd>
inline void find_common(Packet<Simd>& packet, unsigned enter) {
  packet.mixed = false;
  for (int axis = 0; axis < 3; ++axis) {
    const unsigned forward =
        enter & Simd::at_least(Simd::load_rays(packet.cull_d[axis]), Simd::all_rays(0.0F));
    packet.backward[axis] = forward == 0;
    packet.mixed = packet.mixed || (forward != 0 && forward != enter);
  }
  using I = typename Simd::I;
  const std::int64_t kz = packet.kz[__builtin_ctz(enter)];
  unsigned others = 0;
  for (int first = 0; first < Simd::kRays; first += Simd::kDoubles) {
    others |= Simd::bits(load_as<I>(packet.kz + first) != kz) << first;
  }
  packet.common_kz = (others & enter) == 0 ? static_cast<int>(kz) : -1;
}

/// Sets up rays row … row + count − 1; lanes beyond `count` repeat the last.
template <class Simd, class Keep>
inline SetUp set_up(const CastScene& scene, const RayBatch& batch, std::size_t row, int count,
                    Packet<Simd>& packet, const Keep& keep) {
  constexpr int kRays = Simd::kRays;
  const double* origin = batch.origins + static_cast<std::ptrdiff_t>(row) * batch.origin_step;
  const double* direction = batch.directions + 3 * row;
  for (int lane = 0; lane < kRays; ++lane) {
    for (int axis = 0; axis < 3; ++axis) {
      packet.o[axis][lane] = origin[axis];
      packet.d[axis][lane] = direction[axis];
    }
    if (lane + 1 < count) {
      origin += batch.origin_step;
      direction += 3;
    }
  }
  packet.length = 1.0;
  SetUp lanes;
  for (int first = 0; first < kRays; first += Simd::kDoubles) {
    const SetUp part = set_up_exact<Simd>(scene, packet, first, keep);
    lanes.enter |= part.enter << first;
    lanes.suspect |= part.suspect << first;
  }
  const unsigned valid = (2U << (count - 1)) - 1U;
  lanes.enter &= valid;
  lanes.suspect &= valid;
  for (int lane = 0; lane < kRays; ++lane) {
    packet.t[lane] = __builtin_inf();
    packet.u[lane] = packet.v[lane] = 0.0;
    packet.primitive[lane] = kNoPrimitive;
    packet.bound[lane] = 3e38F;
  }
  if (lanes.enter != 0) {
    set_up_cull<Simd>(packet);
    find_common<Simd>(packet, lanes.enter);
  }
  return lanes;
}

/// One lane as a ray of its own, and its answer back.
template <class Simd>
inline ExactRay exact_lane(const Packet<Simd>& packet, int lane) {
  ExactRay ray;
  for (int axis = 0; axis < 3; ++axis) ray.o[axis] = packet.o[axis][lane];
  ray.kz = static_cast<int>(packet.kz[lane]);
  ray.kx = ray.kz == 2 ? 0 : ray.kz + 1;
  ray.ky = ray.kx == 2 ? 0 : ray.kx + 1;
  ray.sx = packet.sx[lane];
  ray.sy = packet.sy[lane];
  ray.slope = packet.slope[lane];
  return ray;
}

template <class Simd>
inline CullRay cull_lane(const Packet<Simd>& packet, int lane) {
  CullRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.o[axis] = packet.cull_o[axis][lane];
    ray.d[axis] = packet.cull_d[axis][lane];
    ray.inverse[axis] = packet.inverse[axis][lane];
    ray.near_shift[axis] = packet.near_shift[axis][lane];
    ray.far_shift[axis] = packet.far_shift[axis][lane];
  }
  ray.triangle_pad = packet.triangle_pad[lane];
  ray.start = packet.start[lane];
  ray.length = packet.length;
  return ray;
}

template <class Simd>
inline Nearest nearest_lane(const Packet<Simd>& packet, int lane) {
  return {packet.t[lane], packet.u[lane], packet.v[lane],
          static_cast<std::uint32_t>(packet.primitive[lane])};
}

template <class Simd>
inline void keep_lane(Packet<Simd>& packet, int lane, const Nearest& best, float bound) {
  packet.t[lane] = best.t;
  packet.u[lane] = best.u;
  packet.v[lane] = best.v;
  packet.primitive[lane] = best.primitive;
  packet.bound[lane] = bound;
}

}  // namespace
}  // namespace bathyal::scene
