// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "bathyal/scene/cut.hpp"
#include "bathyal/scene/hierarchy.hpp"

namespace bathyal {
namespace {

using scene::Cutter;

/// The boxes a section may meet: those within its slack of the plane and of the strip. In double,
/// in the hierarchy's frame.
class Slab {
 public:
  Slab(const Cutter& cutter, const Scene::Hierarchy& hierarchy) : cutter_(cutter) {
    const Vec3 shift = hierarchy.origin - cutter.anchor();
    height_ = cutter.normal().dot(shift);
    along_ = cutter.along().dot(shift);
    // Twice: once for a vertex that counts as lying in the plane, once for the rounding here.
    const double reach =
        hierarchy.origin.lpNorm<Eigen::Infinity>() +
        std::max(hierarchy.low.lpNorm<Eigen::Infinity>(), hierarchy.high.lpNorm<Eigen::Infinity>());
    height_slack_ = 2.0 * cutter.height_slack(reach);
    along_slack_ = 2.0 * cutter.along_slack(reach);
  }

  /// Lane `lane` of a node; false for an empty lane, whose box is NaN in the middle.
  bool meets(const scene::WideNode& node, int lane) const {
    Vec3 middle, half;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = node.low[axis][lane];
      const double high = node.high[axis][lane];
      middle[axis] = 0.5 * (low + high);
      half[axis] = 0.5 * (high - low);
    }
    const double height = height_ + cutter_.normal().dot(middle);
    if (!(std::abs(height) <= cutter_.normal().cwiseAbs().dot(half) + height_slack_)) return false;
    if (!cutter_.has_strip()) return true;
    const double s = along_ + cutter_.along().dot(middle);
    const double width = cutter_.along().cwiseAbs().dot(half) + along_slack_;
    return s + width >= 0.0 && s - width <= cutter_.length();
  }

 private:
  Cutter cutter_;
  double height_, along_;  // of the hierarchy's origin
  double height_slack_, along_slack_;
};

std::vector<Polyline> cut_scene(const Cutter& cutter, const Scene::Hierarchy& hierarchy) {
  scene::CutCollector collector(cutter);
  const Slab slab(cutter, hierarchy);
  std::vector<std::int32_t> waiting;
  if (!hierarchy.nodes.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const std::int32_t item = waiting.back();
    waiting.pop_back();
    if (item < 0) {  // a block
      const scene::TriangleBlock& block = hierarchy.blocks[static_cast<std::size_t>(~item)];
      for (const std::uint32_t primitive : block.primitive) {
        if (primitive == scene::kNoPrimitive) break;
        const auto [mesh, triangle] = hierarchy.name(primitive);
        collector.add(hierarchy.corners(primitive), mesh, triangle);
      }
      continue;
    }
    const scene::WideNode& node = hierarchy.nodes[static_cast<std::size_t>(item)];
    for (int lane = 0; lane < scene::kWidth; ++lane) {
      if (slab.meets(node, lane)) waiting.push_back(node.child[lane]);
    }
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
