// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/cast_kernel.hpp"

#include "bathyal/base/parallel.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/scene/internal/hierarchy.hpp"
#include "bathyal/scene/internal/instances.hpp"
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

InstanceKernels instance_kernels() {
#if defined(BATHYAL_X86_KERNELS)
  switch (simd_level()) {
    case SimdLevel::kAvx512:
      return avx512_instance_kernels();
    case SimdLevel::kAvx2:
      return avx2_instance_kernels();
    case SimdLevel::kBaseline:
      break;
  }
#endif
  return baseline_instance_kernels();
}

RayBatch batch_of(PointView first, PointView second, std::size_t begin, std::size_t end) {
  return {first.data(), first.rows() == 1 && second.rows() != 1 ? 0 : 3, second.data(), begin, end};
}

}  // namespace

void set_local_frame(CastScene& view, const LocalFrame& frame) {
  for (int axis = 0; axis < 3; ++axis) {
    view.origin[axis] = frame.origin[axis];
    view.low[axis] = frame.low[axis];
    view.high[axis] = frame.high[axis];
  }
  view.reach = frame.reach();
}

CastScene cast_view(const Scene::Hierarchy& hierarchy) {
  CastScene view;
  view.nodes = hierarchy.nodes.data();
  view.blocks = hierarchy.blocks.data();
  view.meshes = hierarchy.arrays.data();
  view.mesh_count = static_cast<std::int32_t>(hierarchy.arrays.size());
  set_local_frame(view, hierarchy);
  view.far_pad = kFarPad;
  return view;
}

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
  const auto cast_all = [&](const auto& view, auto kernel) {
    parallel_for(hits.size(), scene::kRayGrain, num_threads,
                 [&](std::size_t begin, std::size_t end) {
                   const std::size_t bad =
                       kernel(view, scene::batch_of(origins, directions, begin, end), hits.data());
                   if (bad != scene::kNoRow) {
                     scene::throw_bad_row(origins, directions, static_cast<Index>(bad), "origins",
                                          "directions", "finite directions of any length but zero");
                   }
                 });
  };
  if (instances_) {
    cast_all(instances_->view(), scene::instance_kernels().cast);
  } else {
    cast_all(scene::cast_view(*hierarchy_), scene::kernels().cast);
  }
}

std::vector<bool> Scene::occluded(PointView from, PointView to, int num_threads) const {
  scene::check_rows(from, to, "from", "to");
  std::vector<std::uint8_t> blocked(static_cast<std::size_t>(to.rows()));
  const auto look_at_all = [&](const auto& view, auto kernel) {
    parallel_for(blocked.size(), scene::kRayGrain, num_threads,
                 [&](std::size_t begin, std::size_t end) {
                   const std::size_t bad =
                       kernel(view, scene::batch_of(from, to, begin, end), blocked.data());
                   if (bad != scene::kNoRow) {
                     scene::throw_bad_row(from, to, static_cast<Index>(bad), "from", "to",
                                          "finite coordinates");
                   }
                 });
  };
  if (instances_) {
    look_at_all(instances_->view(), scene::instance_kernels().occluded);
  } else {
    look_at_all(scene::cast_view(*hierarchy_), scene::kernels().occluded);
  }
  return {blocked.begin(), blocked.end()};
}

}  // namespace bathyal
