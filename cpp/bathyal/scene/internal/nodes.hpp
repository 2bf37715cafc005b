// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// What the hierarchy is made of: plain arrays, so that the kernels compiled for one instruction set
// may include this header (they include neither Eigen nor containers).

namespace bathyal::scene {

/// Children of a node, and triangles of a block.
inline constexpr int kWidth = 8;

/// A lane of WideNode::child that holds nothing; its box is empty (low > high).
inline constexpr std::int32_t kNoChild = INT32_MIN;

/// A lane of TriangleBlock::primitive that holds nothing.
inline constexpr std::uint32_t kNoPrimitive = UINT32_MAX;

/// Most entries that a depth-first walk can have waiting (build.cpp bounds the depth).
inline constexpr int kStackSize = 1024;

/// Farthest from the middle of all that a box may reach [m]: products of three lengths stay far
/// from float's limit.
inline constexpr double kLargestReach = 1e12;

/// Up to eight boxes in the local frame of the hierarchy [m], rounded outwards.
struct alignas(64) WideNode {
  float low[3][kWidth];   ///< [axis][child]; +inf where there is no child
  float high[3][kWidth];  ///< [axis][child]; −inf where there is no child

  /// ≥ 0: a node, with a higher number than this one; kNoChild: nothing; else ~child is a block, or
  /// in the tree over instances the row of one.
  std::int32_t child[kWidth];

  /// Where the child is a block: no less than |e1|₁ and |e2|₁ of each of its triangles [m].
  float edge[kWidth];
};

/// Up to eight triangles in the local frame [m], each number the nearest float: only good enough to
/// rule triangles out. Decisions are taken on the mesh's own vertices, found through `primitive`.
/// Lanes without a triangle come last and hold NaN.
struct alignas(32) TriangleBlock {
  float v0[3][kWidth];  ///< corner 0
  float e1[3][kWidth];  ///< corner 1 − corner 0
  float e2[3][kWidth];  ///< corner 2 − corner 0
  std::uint32_t primitive[kWidth];
};

/// The arrays of one mesh. Its triangles are the primitives from first_primitive on.
struct MeshArrays {
  const double* vertices;         ///< (N, 3)
  const std::int32_t* triangles;  ///< (T, 3)
  std::uint32_t first_primitive;
};

/// A triangle of the scene.
struct PrimitiveName {
  std::int32_t mesh;
  std::int32_t triangle;
};

/// Primitives are numbered through all meshes, so that their order is that of (mesh, triangle).
/// Meshes without triangles share their number with the next one and are passed over.
/// Always inlined: a copy compiled for one instruction set must not be called by another.
[[gnu::always_inline]] inline PrimitiveName name_of(const MeshArrays* meshes,
                                                    std::int32_t mesh_count,
                                                    std::uint32_t primitive) {
  std::int32_t low = 0;
  std::int32_t high = mesh_count;  // the last mesh that starts at or before the primitive
  while (high - low > 1) {
    const std::int32_t middle = low + (high - low) / 2;
    (meshes[middle].first_primitive <= primitive ? low : high) = middle;
  }
  return {low, static_cast<std::int32_t>(primitive - meshes[low].first_primitive)};
}

}  // namespace bathyal::scene
