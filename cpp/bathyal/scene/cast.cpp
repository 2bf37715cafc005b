// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/cast_kernel.hpp"

#include <algorithm>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/scene/hierarchy.hpp"

namespace bathyal {
namespace scene {
namespace {

constexpr std::size_t kGrain = 4096;  ///< rays of one task

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
  scene.reach = std::max(h.low.cwiseAbs().maxCoeff(), h.high.cwiseAbs().maxCoeff());
  return scene;
}

std::string row_text(PointView rows, Index row) {
  return "row " + std::to_string(row) + " = (" + to_text(rows(row, 0)) + ", " +
         to_text(rows(row, 1)) + ", " + to_text(rows(row, 2)) + ")";
}

[[noreturn]] void throw_bad_row(PointView first, PointView second, std::size_t at,
                                std::string_view first_name, std::string_view second_name) {
  const auto row = static_cast<Index>(at);
  const Index first_row = first.rows() == 1 ? 0 : row;
  if (!first.row(first_row).allFinite()) {
    throw_argument(first_name, "finite coordinates", row_text(first, first_row));
  }
  throw_argument(second_name,
                 second_name == "directions" ? "finite directions of any length but zero"
                                             : "finite coordinates",
                 row_text(second, row));
}

void check_rows(PointView first, PointView second, std::string_view first_name,
                std::string_view second_name) {
  if (first.rows() == second.rows() || first.rows() == 1) return;
  throw_argument(first_name,
                 "one row, or as many as `" + std::string(second_name) + "` (" +
                     std::to_string(second.rows()) + ")",
                 std::to_string(first.rows()) + " rows");
}

RayBatch batch_of(PointView first, PointView second, std::size_t begin, std::size_t end) {
  return {first.data(), first.rows() == 1 && second.rows() != 1 ? 0 : 3, second.data(), begin, end};
}

}  // namespace
}  // namespace scene

RayHit Scene::cast(const Vec3& origin, const Vec3& direction) const {
  return cast(PointView(origin.data(), 1, 3), PointView(direction.data(), 1, 3), 1).front();
}

std::vector<RayHit> Scene::cast(PointView origins, PointView directions, int num_threads) const {
  scene::check_rows(origins, directions, "origins", "directions");
  const scene::CastScene view = scene::cast_scene(*hierarchy_);
  const scene::CastKernel kernel = scene::kernels().cast;
  std::vector<RayHit> hits(static_cast<std::size_t>(directions.rows()));
  parallel_for(hits.size(), scene::kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t bad =
        kernel(view, scene::batch_of(origins, directions, begin, end), hits.data());
    if (bad != scene::kNoRow) {
      scene::throw_bad_row(origins, directions, bad, "origins", "directions");
    }
  });
  return hits;
}

std::vector<bool> Scene::occluded(PointView from, PointView to, int num_threads) const {
  scene::check_rows(from, to, "from", "to");
  const scene::CastScene view = scene::cast_scene(*hierarchy_);
  const scene::OccludedKernel kernel = scene::kernels().occluded;
  std::vector<std::uint8_t> blocked(static_cast<std::size_t>(to.rows()));
  parallel_for(blocked.size(), scene::kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t bad = kernel(view, scene::batch_of(from, to, begin, end), blocked.data());
    if (bad != scene::kNoRow) scene::throw_bad_row(from, to, bad, "from", "to");
  });
  return {blocked.begin(), blocked.end()};
}

}  // namespace bathyal
