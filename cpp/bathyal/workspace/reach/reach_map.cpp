// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/reach_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/reach/internal/reach_clearance.hpp"
#include "bathyal/workspace/reach/internal/reach_fill.hpp"
#include "bathyal/workspace/reach/internal/reach_sweep.hpp"

namespace bathyal {
namespace {

using workspace::has;
using workspace::ReachArm;
using workspace::ReachGrid;
using workspace::ReachPostures;
using workspace::ReachState;

constexpr std::size_t kBoxSamples = 4096;
constexpr double kMargin = 0.08;  ///< of the box around those samples, over its half size
constexpr int kTries = 2;
constexpr std::size_t kMostPairs = std::size_t{1} << 28U;

/// A box around the reach, the foot in the middle of a voxel: what lies in the plane of a planar
/// arm then lies in voxels' middles.
ReachGrid grid_of(const ReachArm& arm, const workspace::PostureSequence& sequence,
                  const ReachMapOptions& options) {
  const Eigen::AlignedBox3d tips = box_of_tips(arm, sequence, kBoxSamples, options.num_threads);
  const Vec3 foot = (arm.arm.base() * arm.arm.root()).translation();
  const double margin = kMargin * 0.5 * tips.sizes().maxCoeff();
  ReachGrid grid{.voxel = options.voxel};
  double total = 1.0;
  for (Index k = 0; k < 3; ++k) {
    const double low = std::ceil((foot[k] - tips.min()[k] + margin) / options.voxel);
    const double high = std::ceil((tips.max()[k] - foot[k] + margin) / options.voxel);
    total *= low + high + 1.0;
    if (!(total * options.directions <= static_cast<double>(kMostPairs))) {
      throw_argument("voxel", "at most 2^28 pairs of a voxel and a direction",
                     to_text(options.voxel) + " m, which makes more");
    }
    grid.origin[k] = foot[k] - (low + 0.5) * options.voxel;
    grid.count[k] = static_cast<int>(low + high) + 1;
  }
  return grid;
}

ReachMap map_of(const ReachGrid& grid, const std::vector<Vec3>& approach, const ReachState& state) {
  ReachMap map{grid.origin, grid.voxel, grid.count, approach, {}, {}, {}, {}, {}, {}};
  const std::size_t total = grid.total();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  map.reached.resize(total);
  map.free.resize(total);
  map.reached_along.resize(total * approach.size());
  map.directions.resize(total);
  map.manipulability.assign(total, nan);
  map.clearance.assign(total, nan);
  for (std::size_t v = 0; v < total; ++v) {
    for (std::size_t i = 0; i < approach.size(); ++i) {
      const bool along = has(state.set[v], i);
      map.reached_along[v * approach.size() + i] = along ? 1 : 0;
      map.directions[v] = static_cast<std::uint8_t>(map.directions[v] + (along ? 1 : 0));
    }
    map.reached[v] = map.directions[v] > 0 || has(state.set[v], approach.size()) ? 1 : 0;
    if (map.reached[v] != 0 && state.manipulability[v] >= 0.0F) {
      map.manipulability[v] = state.manipulability[v];
    }
  }
  return map;
}

/// Of voxels that no posture was drawn into: of the first that was found for them.
void add_manipulability(const ReachArm& arm, const ReachState& state, const ReachPostures& postures,
                        int num_threads, ReachMap& map) {
  const std::size_t sets = map.approach.size() + 1;
  std::vector<std::size_t> voxels;
  for (std::size_t v = 0; v < map.total(); ++v) {
    if (map.reached[v] != 0 && std::isnan(map.manipulability[v])) voxels.push_back(v);
  }
  JointMatrix q(static_cast<Index>(voxels.size()), arm.arm.size());
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    std::size_t i = 0;
    while (!has(state.set[voxels[k]], i)) ++i;
    postures.get(state.posture[voxels[k] * sets + i], q.row(static_cast<Index>(k)).data());
  }
  const std::vector<double> found = manipulability(arm.arm, view_of(q), Manipulability::kYoshikawa,
                                                   JacobianPart::kAll, num_threads);
  for (std::size_t k = 0; k < voxels.size(); ++k) {
    map.manipulability[voxels[k]] = static_cast<float>(found[k]);
  }
}

}  // namespace

void ReachMapOptions::check() const {
  check_positive("voxel", voxel);
  if (directions != 6 && directions != 26 && directions != 98) {
    throw_argument("directions", "6, 26 or 98", std::to_string(directions));
  }
  if (samples < 0 || samples > static_cast<Index>(ReachPostures::kMostSamples)) {
    throw_argument("samples", "a number from 0 to 2097152", std::to_string(samples));
  }
  resolve_threads(num_threads);
}

Index ReachMap::index_of(const Vec3& point) const {
  const Eigen::Array3d at = ((point - origin) / voxel).array().floor();
  if (!((at >= 0.0).all() && (at < count.cast<double>()).all())) return -1;
  const auto k = at.cast<Index>();
  return (k[0] * count[1] + k[1]) * count[2] + k[2];
}

Vec3 ReachMap::middle(Index index) const {
  return ReachGrid{origin, voxel, count}.middle(static_cast<std::size_t>(index));
}

ReachMap reach_map(const Workspace& ws, const ReachMapOptions& options) {
  options.check();
  const ReachArm arm(ws.arm());
  const workspace::PostureSequence sequence(arm, options.seed);
  const ReachGrid grid = grid_of(arm, sequence, options);
  const std::vector<Vec3> approach = workspace::approach_directions(options.directions);
  const std::size_t total = grid.total();
  std::size_t samples = static_cast<std::size_t>(options.samples);
  if (samples == 0)
    samples = std::clamp(total / 4, std::size_t{1} << 16U, ReachPostures::kMostSamples);

  ReachState state{std::vector<workspace::ReachSet>(total),
                   std::vector<std::uint32_t>(total * (approach.size() + 1), ReachPostures::kNone),
                   std::vector<float>(total, -1.0F),
                   std::vector<std::uint32_t>(total, ReachPostures::kNone),
                   {}};
  sweep_postures(arm, grid, approach, sequence, samples, options.num_threads, state);
  ReachPostures postures{&arm, sequence, {}};
  if (!arm.exact_directions) {
    confirm(arm, grid, approach, true, options.num_threads, state, postures);
  }
  grow(arm, grid, approach, kTries, options.num_threads, state, postures);
  confirm(arm, grid, approach, false, options.num_threads, state, postures);
  grow(arm, grid, approach, kTries, options.num_threads, state, postures);

  ReachMap map = map_of(grid, approach, state);
  add_manipulability(arm, state, postures, options.num_threads, map);
  if (options.check_clearance) {
    find_free(ws, arm, grid, state, postures, options.num_threads, map);
  }
  return map;
}

}  // namespace bathyal
