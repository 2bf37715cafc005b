// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "bathyal/scene/internal/instance_frame.hpp"
#include "bathyal/scene/internal/nodes.hpp"
#include "bathyal/scene/ray_hit.hpp"

// The border between the scene and the kernels that are compiled once for each instruction set:
// plain pointers only.

namespace bathyal::scene {

/// What a double decision may be off by, as a part of the distance of the ray's origin.
inline constexpr double kFarPad = 0x1p-48;

/// What a kernel needs of a hierarchy.
struct CastScene {
  const WideNode* nodes;  ///< null when there is no triangle
  const TriangleBlock* blocks;
  const MeshArrays* meshes;
  std::int32_t mesh_count;
  double origin[3];  ///< of the local frame, in the world
  double low[3];     ///< box of all triangles in the local frame
  double high[3];
  double reach;    ///< largest absolute coordinate of that box
  double far_pad;  ///< what a decision may be off by, as a part of the distance of the ray's origin
};

/// What a kernel needs of instances.
struct InstancedScene {
  CastScene top;                ///< over the instances' boxes in the world; no blocks and no meshes
  const CastScene* meshes;      ///< the distinct ones, each in its own frame
  const InstanceFrame* frames;  ///< of each row
  std::int32_t home;            ///< row at the identity with the tree's own origin, −1 for none
};

/// Rays begin … end − 1 of a batch. `origins` steps by `origin_step` doubles from ray to ray: 3, or
/// 0 where one origin serves all.
struct RayBatch {
  const double* origins;
  std::ptrdiff_t origin_step;
  const double* directions;  ///< of rays; of segments, their far ends
  std::size_t begin;
  std::size_t end;
};

/// All rays were fine.
inline constexpr std::size_t kNoRow = SIZE_MAX;

/// Nearest hit of every ray to hits[row]. Returns the first row whose origin is not finite or whose
/// direction is zero or not finite, else kNoRow.
using CastKernel = std::size_t (*)(const CastScene&, const RayBatch&, RayHit* hits);

/// Whether segment [origins, directions] meets anything, 0 or 1, to blocked[row]. Returns the first
/// row with an end that is not finite, else kNoRow.
using OccludedKernel = std::size_t (*)(const CastScene&, const RayBatch&, std::uint8_t* blocked);

/// The same for instances.
using CastInstancesKernel = std::size_t (*)(const InstancedScene&, const RayBatch&, RayHit* hits);
using OccludedInstancesKernel = std::size_t (*)(const InstancedScene&, const RayBatch&,
                                                std::uint8_t* blocked);

struct CastKernels {
  CastKernel cast;
  OccludedKernel occluded;
};

struct InstanceKernels {
  CastInstancesKernel cast;
  OccludedInstancesKernel occluded;
};

// Those for instances are compiled apart: the compiler then inlines the walk down a hierarchy into
// the kernels for one as it did without them.
CastKernels baseline_kernels();
InstanceKernels baseline_instance_kernels();
#if defined(BATHYAL_X86_KERNELS)
CastKernels avx2_kernels();
CastKernels avx512_kernels();
InstanceKernels avx2_instance_kernels();
InstanceKernels avx512_instance_kernels();
#endif

}  // namespace bathyal::scene
