// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_clearance.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bathyal/base/parallel.hpp"
#include "bathyal/workspace/reach/internal/reach_solver.hpp"

namespace bathyal::workspace {
namespace {

constexpr std::size_t kMostPostures = 8;  ///< of a voxel's own that are looked at
constexpr int kNeighbours = 3;            ///< whose posture is tried
constexpr std::size_t kVoxels = 1024;     ///< of one task

/// ReachPostures to look at, one a voxel, and what was found.
struct Looked {
  std::vector<std::size_t> voxel;
  JointMatrix q;
  std::vector<std::uint8_t> reached;
  std::vector<double> distance;
};

/// Brings the tip of each row of q to its voxel's middle first. `own`: where that fails the posture
/// stays as it was, with the tip somewhere in the voxel.
void look(const Workspace& ws, const ReachArm& arm, const ReachGrid& grid, bool own,
          Looked& looked) {
  std::vector<ReachTarget> targets;
  for (const std::size_t v : looked.voxel) targets.push_back({grid.middle(v), Vec3::Zero()});
  const JointMatrix before = looked.q;
  looked.reached = solve_targets(arm, targets, looked.q).reached;
  for (std::size_t a = 0; own && a < looked.reached.size(); ++a) {
    if (looked.reached[a] != 0) continue;
    looked.q.row(static_cast<Index>(a)) = before.row(static_cast<Index>(a));
    looked.reached[a] = 1;
  }
  looked.distance.clear();
  for (const Clearance& clear : ws.clearance(view_of(looked.q), {}, TipContact::kAllowed, 1)) {
    looked.distance.push_back(clear.least());
  }
}

/// Codes of a voxel's postures, each once: the most manipulable, in any orientation, along each
/// direction.
std::vector<std::uint32_t> codes_of(const ReachState& state, std::size_t voxel,
                                    std::size_t directions) {
  std::vector<std::uint32_t> codes{state.best[voxel]};
  for (std::size_t k = directions + 1; k-- > 0;) {
    if (!has(state.set[voxel], k)) continue;
    const std::uint32_t code = state.posture[voxel * (directions + 1) + k];
    if (std::ranges::find(codes, code) == codes.end()) codes.push_back(code);
  }
  std::erase(codes, ReachPostures::kNone);
  if (codes.size() <= kMostPostures) return codes;
  std::vector<std::uint32_t> some;
  for (std::size_t k = 0; k < kMostPostures; ++k) {
    some.push_back(codes[k * codes.size() / kMostPostures]);
  }
  return some;
}

class FreeSearch {
 public:
  FreeSearch(const Workspace& ws, const ReachArm& arm, const ReachGrid& grid,
             const ReachState& state, const ReachPostures& postures, ReachMap& map)
      : ws_(ws),
        arm_(arm),
        grid_(grid),
        state_(state),
        postures_(postures),
        map_(map),
        free_q_(grid.total() * arm.size()) {}

  /// Of voxels begin … end − 1, the postures they have.
  void look_at_own(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> voxels;
    std::vector<std::vector<std::uint32_t>> codes;
    for (std::size_t v = begin; v < end; ++v) {
      if (map_.reached[v] == 0) continue;
      voxels.push_back(v);
      codes.push_back(codes_of(state_, v, map_.approach.size()));
    }
    for (std::size_t turn = 0; turn < kMostPostures; ++turn) {
      std::vector<std::size_t> asked;
      Looked looked;
      for (std::size_t k = 0; k < voxels.size(); ++k) {
        if (map_.free[voxels[k]] != 0 || turn >= codes[k].size()) continue;
        asked.push_back(k);
        looked.voxel.push_back(voxels[k]);
      }
      if (asked.empty()) return;
      looked.q.resize(static_cast<Index>(asked.size()), arm_.arm.size());
      for (std::size_t a = 0; a < asked.size(); ++a) {
        postures_.get(codes[asked[a]][turn], looked.q.row(static_cast<Index>(a)).data());
      }
      look(ws_, arm_, grid_, true, looked);
      enter(looked);
    }
  }

  /// Until no voxel has a free neighbour that it has not been tried from.
  void grow(int num_threads) {
    const std::size_t tasks = (grid_.total() + kVoxels - 1) / kVoxels;
    std::vector<std::uint8_t> tried(grid_.total(), 0);
    bool again = true;
    while (again) {
      std::vector<Looked> looked(tasks);
      parallel_for(grid_.total(), kVoxels, num_threads, [&](std::size_t begin, std::size_t end) {
        Looked& own = looked[begin / kVoxels];
        std::vector<std::size_t> from;
        for (std::size_t v = begin; v < end; ++v) collect(v, tried[v], own.voxel, from);
        own.q.resize(static_cast<Index>(from.size()), arm_.arm.size());
        for (std::size_t a = 0; a < from.size(); ++a) {
          for (std::size_t j = 0; j < arm_.size(); ++j) {
            own.q(static_cast<Index>(a), static_cast<Index>(j)) =
                free_q_[from[a] * arm_.size() + j];
          }
        }
        if (!from.empty()) look(ws_, arm_, grid_, false, own);
      });
      again = false;
      for (const Looked& one : looked) {
        again = again || !one.voxel.empty();
        enter(one);
      }
    }
  }

 private:
  void collect(std::size_t v, std::uint8_t& tried, std::vector<std::size_t>& voxels,
               std::vector<std::size_t>& from) const {
    if (map_.reached[v] == 0 || map_.free[v] != 0 || std::popcount(tried) >= kNeighbours) return;
    const std::array<Index, 6> near = neighbours(grid_, v);
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t turn = (k + v) % 6;
      if (near[turn] < 0 || ((tried >> turn) & 1U) != 0) continue;
      if (map_.free[static_cast<std::size_t>(near[turn])] == 0) continue;
      tried = static_cast<std::uint8_t>(tried | (1U << turn));
      voxels.push_back(v);
      from.push_back(static_cast<std::size_t>(near[turn]));
      return;
    }
  }

  void enter(const Looked& looked) {
    for (std::size_t a = 0; a < looked.voxel.size(); ++a) {
      if (looked.reached[a] == 0) continue;
      const std::size_t v = looked.voxel[a];
      map_.clearance[v] = std::fmax(map_.clearance[v], static_cast<float>(looked.distance[a]));
      if (!(looked.distance[a] > 0.0) || map_.free[v] != 0) continue;
      map_.free[v] = 1;
      for (std::size_t j = 0; j < arm_.size(); ++j) {
        free_q_[v * arm_.size() + j] =
            static_cast<float>(looked.q(static_cast<Index>(a), static_cast<Index>(j)));
      }
    }
  }

  const Workspace& ws_;
  const ReachArm& arm_;
  const ReachGrid& grid_;
  const ReachState& state_;
  const ReachPostures& postures_;
  ReachMap& map_;
  std::vector<float> free_q_;  ///< the posture of each free voxel
};

}  // namespace

void find_free(const Workspace& ws, const ReachArm& arm, const ReachGrid& grid,
               const ReachState& state, const ReachPostures& postures, int num_threads,
               ReachMap& map) {
  FreeSearch search(ws, arm, grid, state, postures, map);
  parallel_for(grid.total(), kVoxels, num_threads,
               [&](std::size_t begin, std::size_t end) { search.look_at_own(begin, end); });
  search.grow(num_threads);
}

}  // namespace bathyal::workspace
