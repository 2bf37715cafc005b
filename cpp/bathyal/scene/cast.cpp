// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/cast_kernel.hpp"

#include "bathyal/base/parallel.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/ray_rows.hpp"

namespace bathyal {
namespace scene {
namespace {

constexpr std::size_t kRayGrain = 4096;  ///< rays of one task

CastKernels kernels() {
#if defined(BATHYAL_X86_KERNELS)
  switch (simd_level()) {
    case SimdLevel::kAvx512:
      return avx512_kernels();
    case SimdLevel::kAvx2:
      return avx2_kernels();
    case SimdLevel::kBaseline:
      break;
  }
#endif
  return baseline_kernels();
}

CastScene cast_scene(const Scene::Hierarchy& h) {
  CastScene scene;
  scene.nodes = h.nodes.data();
  scene.blocks = h.blocks.data();
  scene.meshes = h.arrays.data();
  scene.mesh_count = static_cast<std::int32_t>(h.arrays.size());
  for (int axis = 0; axis < 3; ++axis) {
    scene.origin[axis] = h.origin[axis];
    scene.low[axis] = h.low[axis];
    scene.high[axis] = h.high[axis];
  }
  scene.reach = h.reach();
  return scene;
}

RayBatch batch_of(PointView first, PointView second, std::size_t begin, std::size_t end) {
  return {first.data(), first.rows() == 1 && second.rows() != 1 ? 0 : 3, second.data(), begin, end};
}

}  // namespace
}  // namespace scene

RayHit Scene::cast(const Vec3& origin, const Vec3& direction) const {
  RayHit hit;
  cast(PointView(origin.data(), 1, 3), PointView(direction.data(), 1, 3), {&hit, 1}, 1);
  return hit;
}

std::vector<RayHit> Scene::cast(PointView origins, PointView directions, int num_threads) const {
  std::vector<RayHit> hits(static_cast<std::size_t>(directions.rows()));
  cast(origins, directions, hits, num_threads);
  return hits;
}

void Scene::cast(PointView origins, PointView directions, std::span<RayHit> hits,
                 int num_threads) const {
  scene::check_rows(origins, directions, "origins", "directions");
  const scene::CastScene view = scene::cast_scene(*hierarchy_);
  const scene::CastKernel kernel = scene::kernels().cast;
  parallel_for(hits.size(), scene::kRayGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t bad =
        kernel(view, scene::batch_of(origins, directions, begin, end), hits.data());
    if (bad != scene::kNoRow) {
      scene::throw_bad_row(origins, directions, static_cast<Index>(bad), "origins", "directions",
                           "finite directions of any length but zero");
    }
  });
}

std::vector<bool> Scene::occluded(PointView from, PointView to, int num_threads) const {
  scene::check_rows(from, to, "from", "to");
  const scene::CastScene view = scene::cast_scene(*hierarchy_);
  const scene::OccludedKernel kernel = scene::kernels().occluded;
  std::vector<std::uint8_t> blocked(static_cast<std::size_t>(to.rows()));
  parallel_for(
      blocked.size(), scene::kRayGrain, num_threads, [&](std::size_t begin, std::size_t end) {
        const std::size_t bad = kernel(view, scene::batch_of(from, to, begin, end), blocked.data());
        if (bad != scene::kNoRow) {
          scene::throw_bad_row(from, to, static_cast<Index>(bad), "from", "to",
                               "finite coordinates");
        }
      });
  return {blocked.begin(), blocked.end()};
}

}  // namespace bathyal
