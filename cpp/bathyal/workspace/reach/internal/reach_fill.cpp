// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_fill.hpp"

#include <algorithm>
#include <bit>

#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/reach/internal/reach_solver.hpp"

namespace bathyal::workspace {
namespace {

constexpr std::size_t kVoxelGrain = 4096;  ///< voxels of one task
constexpr std::size_t kBlock = 512;        ///< targets solved together

struct Attempt {
  std::size_t voxel;
  std::size_t direction;  ///< approach.size(): any
  std::uint32_t start;
};

struct Found {
  std::size_t voxel;
  std::size_t direction;
};

/// What the voxels of one chunk have come to.
struct Findings {
  std::vector<Found> found;
  std::vector<float> q;
};

struct Setting {
  const ReachArm& arm;
  const ReachGrid& grid;
  const std::vector<Vec3>& approach;
  NearestDirection nearest;
};

void attempt(const Setting& setting, const ReachPostures& postures,
             std::span<const Attempt> attempts, Findings& findings) {
  const std::size_t n = setting.arm.size();
  const std::size_t any = setting.approach.size();
  for (std::size_t first = 0; first < attempts.size(); first += kBlock) {
    const auto block = attempts.subspan(first, std::min(kBlock, attempts.size() - first));
    JointMatrix q(static_cast<Index>(block.size()), static_cast<Index>(n));
    std::vector<ReachTarget> targets(block.size());
    for (std::size_t i = 0; i < block.size(); ++i) {
      postures.get(block[i].start, q.row(static_cast<Index>(i)).data());
      targets[i].middle = setting.grid.middle(block[i].voxel);
      if (block[i].direction != any && setting.arm.exact_directions) {
        targets[i].direction = setting.approach[block[i].direction];
      }
    }
    const ReachSolutions solved = solve_targets(setting.arm, targets, q);
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (solved.reached[i] == 0) continue;
      std::size_t direction = block[i].direction;
      if (direction != any && !setting.arm.exact_directions) {
        direction = setting.nearest.exact(solved.z_axis[i]);
      }
      findings.found.push_back({block[i].voxel, direction});
      for (std::size_t j = 0; j < n; ++j) {
        findings.q.push_back(static_cast<float>(q(static_cast<Index>(i), static_cast<Index>(j))));
      }
    }
  }
}

/// Enters a chunk's findings; the first posture of a pair of voxel and direction stays.
void enter(const Findings& findings, std::size_t n, std::size_t any, ReachState& state,
           ReachPostures& postures, std::vector<std::size_t>& changed) {
  for (std::size_t k = 0; k < findings.found.size(); ++k) {
    const Found& one = findings.found[k];
    const auto code = static_cast<std::uint32_t>(postures.found.size() / n) | ReachPostures::kFound;
    bool used = false;
    for (const std::size_t i : {one.direction, any}) {
      if (has(state.set[one.voxel], i)) continue;
      insert(state.set[one.voxel], i);
      state.posture[one.voxel * (any + 1) + i] = code;
      used = true;
    }
    if (!used) continue;
    changed.push_back(one.voxel);
    postures.found.insert(postures.found.end(), findings.q.begin() + static_cast<Index>(k * n),
                          findings.q.begin() + static_cast<Index>((k + 1) * n));
  }
}

/// Calls `collect(voxel, attempts)` for every voxel and solves what it adds; returns how many were
/// tried. `changed`: voxels in which something was found.
template <class Collect>
std::size_t round_of(const Setting& setting, int num_threads, ReachState& state,
                     ReachPostures& postures, const Collect& collect,
                     std::vector<std::size_t>& changed) {
  const std::size_t total = setting.grid.total();
  std::vector<Findings> findings((total + kVoxelGrain - 1) / kVoxelGrain);
  std::vector<std::size_t> tried(findings.size(), 0);
  parallel_for(total, kVoxelGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Attempt> attempts;
    for (std::size_t voxel = begin; voxel < end; ++voxel) collect(voxel, attempts);
    tried[begin / kVoxelGrain] = attempts.size();
    attempt(setting, postures, attempts, findings[begin / kVoxelGrain]);
  });
  std::size_t sum = 0;
  changed.clear();
  for (std::size_t c = 0; c < findings.size(); ++c) {
    enter(findings[c], setting.arm.size(), setting.approach.size(), state, postures, changed);
    sum += tried[c];
  }
  return sum;
}

/// What is reached in a voxel and not in all that have a face in common with it.
ReachSet border_of(const ReachGrid& grid, const std::vector<ReachSet>& set, std::size_t voxel) {
  ReachSet common = set[voxel];
  for (const Index other : neighbours(grid, voxel)) {
    for (std::size_t w = 0; w < kSetWords; ++w) {
      common[w] &= other < 0 ? 0 : set[static_cast<std::size_t>(other)][w];
    }
  }
  for (std::size_t w = 0; w < kSetWords; ++w) common[w] = set[voxel][w] & ~common[w];
  return common;
}

}  // namespace

void confirm(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach,
             bool all, int num_threads, ReachState& state, ReachPostures& postures) {
  const Setting setting{arm, grid, approach, NearestDirection(approach)};
  const std::size_t sets = approach.size() + 1;
  std::vector<ReachSet> again(grid.total());
  std::size_t tried = 1;
  std::vector<std::size_t> changed;
  while (tried > 0) {
    const std::vector<ReachSet> before = state.set;
    parallel_for(grid.total(), kVoxelGrain, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t voxel = begin; voxel < end; ++voxel) {
        again[voxel] = all ? before[voxel] : border_of(grid, before, voxel);
        for (std::size_t i = 0; i < sets; ++i) {
          if (!has(again[voxel], i)) continue;
          const std::uint32_t code = state.posture[voxel * sets + i];
          if ((code & ReachPostures::kFound) != 0) erase(again[voxel], i);
        }
        for (std::size_t w = 0; w < kSetWords; ++w) state.set[voxel][w] &= ~again[voxel][w];
      }
    });
    tried = round_of(
        setting, num_threads, state, postures,
        [&](std::size_t voxel, std::vector<Attempt>& attempts) {
          for (std::size_t i = 0; i < sets; ++i) {
            if (!has(again[voxel], i)) continue;
            attempts.push_back({voxel, i, state.posture[voxel * sets + i]});
          }
        },
        changed);
  }
}

void grow(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach, int tries,
          int num_threads, ReachState& state, ReachPostures& postures) {
  const Setting setting{arm, grid, approach, NearestDirection(approach)};
  const std::size_t sets = approach.size() + 1;
  state.tried.resize(grid.total() * sets, 0);
  std::vector<std::uint8_t> asked(grid.total(), 1);  // whether a voxel may have more to try
  const auto collect = [&](std::size_t voxel, std::vector<Attempt>& attempts) {
    if (asked[voxel] == 0) return;
    asked[voxel] = 0;
    const std::array<Index, 6> near = neighbours(grid, voxel);
    ReachSet border{};
    for (const Index other : near) {
      if (other < 0) continue;
      for (std::size_t w = 0; w < kSetWords; ++w) {
        border[w] |= state.set[static_cast<std::size_t>(other)][w];
      }
    }
    for (std::size_t w = 0; w < kSetWords; ++w) {
      for (std::uint64_t rest = border[w] & ~state.set[voxel][w]; rest != 0; rest &= rest - 1) {
        const std::size_t i = 64 * w + static_cast<std::size_t>(std::countr_zero(rest));
        std::uint8_t& done = state.tried[voxel * sets + i];
        if (std::popcount(done) >= tries) continue;
        for (std::size_t k = 0; k < 6; ++k) {
          const std::size_t turn = (k + voxel + i) % 6;
          const Index other = near[turn];
          if (other < 0 || ((done >> turn) & 1U) != 0) continue;
          const auto from = static_cast<std::size_t>(other);
          if (!has(state.set[from], i)) continue;
          done = static_cast<std::uint8_t>(done | (1U << turn));
          attempts.push_back({voxel, i, state.posture[from * sets + i]});
          asked[voxel] = 1;
          break;
        }
      }
    }
  };
  std::vector<std::size_t> changed;
  while (round_of(setting, num_threads, state, postures, collect, changed) > 0) {
    for (const std::size_t voxel : changed) {
      for (const Index other : neighbours(grid, voxel)) {
        if (other >= 0) asked[static_cast<std::size_t>(other)] = 1;
      }
    }
  }
}

}  // namespace bathyal::workspace
