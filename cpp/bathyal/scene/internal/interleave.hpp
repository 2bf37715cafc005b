// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/scene/internal/packet.hpp"
#include "bathyal/scene/internal/prefetch.hpp"

// Rays of a packet that have parted, walked in turns: a step of one ray prefetches what its next
// step needs and lets the other rays go first. Rays without order wait for memory more than
// they compute, and so wait together.

namespace bathyal::scene {
namespace {

/// What a ray's next step finds waiting in the cache.
enum class Step { kNode, kBlock, kIndices, kCorners, kDone };

struct Walker {
  CullRay cull;
  ExactRay exact;
  Nearest best;
  float bound;
  float edge;  ///< of the block
  Step step;
  unsigned met;        ///< triangles of the block yet to confirm
  std::int32_t child;  ///< the node, or ~block, at hand
  Stack stack;
};

/// Takes the next place from the ray's stack.
inline void advance(const CastScene& scene, Walker& ray) {
  while (ray.stack.size > 0) {
    const std::uint64_t entry = ray.stack.entry[--ray.stack.size];
    if (t_of(entry) > ray.bound) continue;
    const auto place = static_cast<std::uint32_t>(entry);
    const WideNode& node = scene.nodes[place / kWidth];
    ray.child = node.child[place % kWidth];
    if (ray.child >= 0) {
      prefetch(scene.nodes[ray.child]);
      ray.step = Step::kNode;
    } else {
      ray.edge = node.edge[place % kWidth];
      prefetch(scene.blocks[~ray.child]);
      ray.step = Step::kBlock;
    }
    return;
  }
  ray.step = Step::kDone;
}

template <class Simd>
inline void take_step(const CastScene& scene, Walker& ray) {
  switch (ray.step) {
    case Step::kNode:
      push_children<Simd>(ray.cull, scene.nodes[ray.child], static_cast<std::uint32_t>(ray.child),
                          ray.bound, ray.stack);
      advance(scene, ray);
      return;
    case Step::kBlock: {
      const TriangleBlock& block = scene.blocks[~ray.child];
      ray.met = candidates<Simd>(ray.cull, block, ray.edge);
      if (ray.met == 0) return advance(scene, ray);
      for (unsigned rest = ray.met; rest != 0; rest &= rest - 1) {
        prefetch_three(indices_of(scene, block.primitive[__builtin_ctz(rest)]).index);
      }
      ray.step = Step::kIndices;
      return;
    }
    case Step::kIndices:
      for (unsigned rest = ray.met; rest != 0; rest &= rest - 1) {
        const double* corner[3];
        corners_of(scene, scene.blocks[~ray.child].primitive[__builtin_ctz(rest)], corner);
        for (const double* p : corner) prefetch_three(p);
      }
      ray.step = Step::kCorners;
      return;
    case Step::kCorners:
      for (; ray.met != 0; ray.met &= ray.met - 1) {
        confirm(scene, ray.exact, scene.blocks[~ray.child].primitive[__builtin_ctz(ray.met)],
                ray.best);
      }
      ray.bound = cull_bound(ray.cull, ray.best.t);
      advance(scene, ray);
      return;
    case Step::kDone:
      return;
  }
}

/// The rays of a packet that go on by themselves, with the places where they do.
template <class Simd>
struct Walkers {
  Walker ray[Simd::kRays];
  unsigned waiting = 0;  ///< lanes with something on their stack

  /// Leaves a place for later.
  void leave(int lane, float t, std::uint32_t place) {
    Stack& stack = ray[lane].stack;
    if ((waiting >> lane & 1U) == 0) stack.size = 0;
    waiting |= 1U << lane;
    const std::uint64_t entry = entry_of(t, place);
    int at = stack.size++;  // the nearest on top
    for (; at > 0 && stack.entry[at - 1] < entry; --at) stack.entry[at] = stack.entry[at - 1];
    stack.entry[at] = entry;
  }

  void walk_all(const CastScene& scene, Packet<Simd>& packet) {
    int lanes[Simd::kRays];
    int count = 0;
    for (; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      Walker& walker = ray[lane];
      walker.cull = cull_lane(packet, lane);
      walker.exact = exact_lane(packet, lane);
      walker.best = nearest_lane(packet, lane);
      walker.bound = packet.bound[lane];
      advance(scene, walker);
      lanes[count++] = lane;
    }
    while (count > 0) {
      int left = 0;
      for (int i = 0; i < count; ++i) {
        Walker& walker = ray[lanes[i]];
        take_step<Simd>(scene, walker);
        if (walker.step == Step::kDone) {
          keep_lane(packet, lanes[i], walker.best, walker.bound);
        } else {
          lanes[left++] = lanes[i];
        }
      }
      count = left;
    }
  }
};

}  // namespace
}  // namespace bathyal::scene
