// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/scene/cut.hpp"
#include "bathyal/scene/hierarchy.hpp"

namespace bathyal {
namespace {

using scene::Cutter;

/// x ↦ direction · x + offset over the hierarchy's frame, in float, eight lanes at a time; `slack`
/// is what rounding, here and of the boxes' contents, may be worth.
class Gauge {
 public:
  Gauge(const Vec3& direction, double offset, double reach, double slack) {
    const double scale = 1.0 / direction.stableNorm();  // so that no length overflows a float
    direction_ = (scale * direction).cast<float>();
    offset_ = static_cast<float>(scale * offset);
    constexpr double kRounding = 16.0 * std::numeric_limits<float>::epsilon();
    slack_ = static_cast<float>(kRounding * (reach + std::abs(scale * offset)) + scale * slack);
  }

  /// Clears the lanes whose box lies on one side of the range [0, length] altogether; those of an
  /// empty lane are infinite or NaN, and it is cleared too.
  void sift(const scene::WideNode& node, double length,
            std::array<bool, scene::kWidth>& kept) const {
    std::array<const float*, 3> least, most;
    for (int axis = 0; axis < 3; ++axis) {
      const bool rising = direction_[axis] >= 0.0F;
      least[axis] = rising ? node.low[axis] : node.high[axis];
      most[axis] = rising ? node.high[axis] : node.low[axis];
    }
    const float first = -slack_;
    const float last = static_cast<float>(length) + slack_;
    for (std::size_t i = 0; i < scene::kWidth; ++i) {
      const float low = value(least[0][i], least[1][i], least[2][i]);
      const float high = value(most[0][i], most[1][i], most[2][i]);
      kept[i] = kept[i] & (low <= last) & (high >= first);
    }
  }

  /// Clears the lanes whose triangle lies on one side of 0.
  void sift(const scene::TriangleBlock& block, std::array<bool, scene::kWidth>& kept) const {
    for (std::size_t i = 0; i < scene::kWidth; ++i) {
      const float h0 = value(block.v0[0][i], block.v0[1][i], block.v0[2][i]);
      const float h1 = h0 + slope(block.e1[0][i], block.e1[1][i], block.e1[2][i]);
      const float h2 = h0 + slope(block.e2[0][i], block.e2[1][i], block.e2[2][i]);
      const bool above = (h0 > slack_) & (h1 > slack_) & (h2 > slack_);
      const bool below = (h0 < -slack_) & (h1 < -slack_) & (h2 < -slack_);
      kept[i] = kept[i] & !above & !below;
    }
  }

 private:
  float slope(float x, float y, float z) const {
    return direction_[0] * x + direction_[1] * y + direction_[2] * z;
  }
  float value(float x, float y, float z) const { return slope(x, y, z) + offset_; }

  Eigen::Vector3f direction_;
  float offset_ = 0.0F;
  float slack_ = 0.0F;
};

/// The triangles that the section may cut, and few others.
std::vector<std::uint32_t> find_candidates(const Cutter& cutter,
                                           const Scene::Hierarchy& hierarchy) {
  std::vector<std::uint32_t> candidates;
  if (hierarchy.nodes.empty()) return candidates;
  const double reach =
      std::max(hierarchy.low.lpNorm<Eigen::Infinity>(), hierarchy.high.lpNorm<Eigen::Infinity>());
  const double world_reach = reach + hierarchy.origin.lpNorm<Eigen::Infinity>();
  const Vec3 shift = hierarchy.origin - cutter.anchor();
  const Gauge height(cutter.normal(), cutter.normal().dot(shift), reach,
                     cutter.height_slack(world_reach));
  const bool has_strip = cutter.has_strip();
  const double length = cutter.along().norm();
  const Gauge along(has_strip ? cutter.along() : cutter.normal(), cutter.along().dot(shift), reach,
                    cutter.along_slack(world_reach));

  std::vector<std::int32_t> waiting = {0};
  while (!waiting.empty()) {
    const std::int32_t item = waiting.back();
    waiting.pop_back();
    std::array<bool, scene::kWidth> kept;
    kept.fill(true);
    if (item < 0) {  // a block
      const scene::TriangleBlock& block = hierarchy.blocks[static_cast<std::size_t>(~item)];
      height.sift(block, kept);
      for (std::size_t i = 0; i < scene::kWidth; ++i) {
        if (kept[i] && block.primitive[i] != scene::kNoPrimitive) {
          candidates.push_back(block.primitive[i]);
        }
      }
    } else {
      const scene::WideNode& node = hierarchy.nodes[static_cast<std::size_t>(item)];
      height.sift(node, 0.0, kept);
      if (has_strip) along.sift(node, length, kept);
      for (std::size_t i = 0; i < scene::kWidth; ++i) {
        if (kept[i]) waiting.push_back(node.child[i]);
      }
    }
  }
  return candidates;
}

std::vector<Polyline> cut_scene(const Cutter& cutter, const Scene::Hierarchy& hierarchy) {
  const std::vector<std::uint32_t> candidates = find_candidates(cutter, hierarchy);
  scene::CutCollector collector(cutter, candidates.size());
  for (const std::uint32_t primitive : candidates) {
    const auto [mesh, triangle] = hierarchy.name(primitive);
    collector.add(hierarchy.corners(primitive), mesh, triangle);
  }
  return collector.chain();
}

/// A point of the plane near the scene, so that p keeps its digits at survey coordinates. Moved
/// along one axis only: a plane across an axis passes through exactly the offset it was given.
Vec3 anchor_near(const Plane& plane, const Vec3& origin) {
  Eigen::Index axis = 0;
  plane.normal().cwiseAbs().maxCoeff(&axis);
  Vec3 rest = origin;
  rest[axis] = 0.0;
  rest[axis] = (plane.offset() - plane.normal().dot(rest)) / plane.normal()[axis];
  return rest;
}

}  // namespace

std::vector<Polyline> Scene::section(const Plane& plane) const {
  return cut_scene(Cutter(plane.normal(), anchor_near(plane, hierarchy_->origin)), *hierarchy_);
}

std::vector<Polyline> Scene::section(const Vec3& a, const Vec3& b, const Vec3& up) const {
  return cut_scene(Cutter::between(a, b, up), *hierarchy_);
}

}  // namespace bathyal
