// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "bathyal/scene/boxes.hpp"
#include "bathyal/scene/cut.hpp"
#include "bathyal/scene/hierarchy.hpp"

namespace bathyal {
namespace {

using scene::Cutter;

using scene::Float4;

/// Largest coordinate of the scene in the world [m].
double reach_of(const Scene::Hierarchy& hierarchy) {
  return hierarchy.origin.lpNorm<Eigen::Infinity>() +
         std::max(hierarchy.low.lpNorm<Eigen::Infinity>(),
                  hierarchy.high.lpNorm<Eigen::Infinity>());
}

/// x ↦ direction · (x − anchor) over the hierarchy's frame, the direction scaled to unit length, in
/// float and four lanes at a time; it rules out and decides nothing. `slack`, in the direction's
/// own units, is what the rounding of vertices may be worth; that of the floats comes on top.
class Gauge {
 public:
  Gauge(const Scene::Hierarchy& hierarchy, const Vec3& direction, const Vec3& anchor,
        double slack) {
    const double scale = 1.0 / direction.stableNorm();
    const double offset = scale * direction.dot(hierarchy.origin - anchor);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      direction_[axis] = lanes(static_cast<float>(scale * direction[static_cast<Index>(axis)]));
    }
    offset_ = lanes(static_cast<float>(offset));
    const double reach =
        std::max(hierarchy.low.lpNorm<Eigen::Infinity>(), hierarchy.high.lpNorm<Eigen::Infinity>());
    constexpr double kRounding = 16.0 * std::numeric_limits<float>::epsilon();
    slack_ = static_cast<float>(kRounding * (reach + std::abs(offset)) + scale * slack);
  }

  /// The lanes, a bit each, whose box is not clear of the range [0, length]. The box of an empty
  /// lane is infinite or NaN and never among them.
  unsigned sift(const scene::WideNode& node, double length) const {
    std::array<const float*, 3> least, most;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool rising = direction_[axis][0] >= 0.0F;
      least[axis] = rising ? node.low[axis] : node.high[axis];
      most[axis] = rising ? node.high[axis] : node.low[axis];
    }
    const Float4 last = lanes(static_cast<float>(length) + slack_);
    unsigned kept = 0;
    for (std::size_t i = 0; i < scene::kWidth; i += 4) {
      const Float4 low =
          offset_ + slope(load(least[0] + i), load(least[1] + i), load(least[2] + i));
      const Float4 high = offset_ + slope(load(most[0] + i), load(most[1] + i), load(most[2] + i));
      kept |= bits((low <= last) & (high >= lanes(-slack_))) << i;
    }
    return kept;
  }

  /// The lanes whose triangle is not clear of 0; NaN in the lanes without one.
  unsigned sift(const scene::TriangleBlock& block) const {
    unsigned kept = 0;
    const Float4 top = lanes(slack_);
    for (std::size_t i = 0; i < scene::kWidth; i += 4) {
      const auto along = [&](const float(&edge)[3][scene::kWidth]) {
        return slope(load(edge[0] + i), load(edge[1] + i), load(edge[2] + i));
      };
      const Float4 h0 = offset_ + along(block.v0);
      const Float4 h1 = h0 + along(block.e1);
      const Float4 h2 = h0 + along(block.e2);
      kept |= bits((scene::min4(h0, scene::min4(h1, h2)) <= top) &
                   (scene::max4(h0, scene::max4(h1, h2)) >= -top))
              << i;
    }
    return kept;
  }

 private:
  static Float4 lanes(float x) { return Float4{x, x, x, x}; }
  static Float4 load(const float* p) { return Float4{p[0], p[1], p[2], p[3]}; }
  static unsigned bits(scene::Int4 mask) {
    const scene::Int4 bit = mask & scene::Int4{1, 2, 4, 8};
    return static_cast<unsigned>(bit[0] | bit[1] | bit[2] | bit[3]);
  }
  Float4 slope(Float4 x, Float4 y, Float4 z) const {
    return direction_[0] * x + direction_[1] * y + direction_[2] * z;
  }

  std::array<Float4, 3> direction_;  // one number in all lanes each
  Float4 offset_;
  float slack_;
};

/// Calls `work(lane)` for each bit that is set, lowest first.
template <class Work>
void for_each_lane(unsigned lanes, const Work& work) {
  for (; lanes != 0; lanes &= lanes - 1) work(std::countr_zero(lanes));
}

/// Asks the memory for every cache line of `value`.
template <class Value>
void prefetch(const Value& value) {
  constexpr std::size_t kLine = 64;
  const auto* bytes = reinterpret_cast<const char*>(&value);
  for (std::size_t b = 0; b < sizeof(Value); b += kLine) __builtin_prefetch(bytes + b);
}

/// The blocks whose boxes the section may cut. Breadth first: by the time a node is looked at it
/// has long been asked for.
std::vector<std::int32_t> find_blocks(const Cutter& cutter, const Scene::Hierarchy& hierarchy,
                                      const Gauge& height) {
  const bool has_strip = cutter.has_strip();
  const double length = cutter.along().stableNorm();
  const Gauge along(hierarchy, has_strip ? cutter.along() : cutter.normal(), cutter.anchor(),
                    cutter.along_slack(reach_of(hierarchy)));
  std::vector<std::int32_t> blocks;
  std::vector<std::int32_t> nodes = {0};
  for (std::size_t next = 0; next < nodes.size(); ++next) {
    const scene::WideNode& node = hierarchy.nodes[static_cast<std::size_t>(nodes[next])];
    unsigned kept = height.sift(node, 0.0);
    if (has_strip) kept &= along.sift(node, length);
    for_each_lane(kept, [&](int lane) {
      const std::int32_t child = node.child[lane];
      if (child < 0) {
        blocks.push_back(~child);
      } else {
        nodes.push_back(child);
        prefetch(hierarchy.nodes[static_cast<std::size_t>(child)]);
      }
    });
  }
  return blocks;
}

/// Calls `work(i)` for every i, and before it asks the memory for what `fetch(i + kAhead)` names: a
/// section touches a thin trace of a large scene, and would else wait for each of its places.
template <class Fetch, class Work>
void fetching_ahead(std::size_t count, const Fetch& fetch, const Work& work) {
  constexpr std::size_t kAhead = 8;
  for (std::size_t i = 0; i < std::min(kAhead, count); ++i) fetch(i);
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kAhead < count) fetch(i + kAhead);
    work(i);
  }
}

/// The triangles that the section may cut, and few others.
std::vector<std::uint32_t> find_candidates(const Cutter& cutter,
                                           const Scene::Hierarchy& hierarchy) {
  if (hierarchy.nodes.empty()) return {};
  const Gauge height(hierarchy, cutter.normal(), cutter.anchor(),
                     cutter.height_slack(reach_of(hierarchy)));
  const std::vector<std::int32_t> blocks = find_blocks(cutter, hierarchy, height);
  const auto block = [&](std::size_t i) -> const scene::TriangleBlock& {
    return hierarchy.blocks[static_cast<std::size_t>(blocks[i])];
  };
  std::vector<std::uint32_t> candidates;
  candidates.reserve(scene::kWidth * blocks.size());
  fetching_ahead(
      blocks.size(), [&](std::size_t i) { prefetch(block(i)); },
      [&](std::size_t i) {
        for_each_lane(height.sift(block(i)),
                      [&](int lane) { candidates.push_back(block(i).primitive[lane]); });
      });
  return candidates;
}

std::vector<Polyline> cut_scene(const Cutter& cutter, const Scene::Hierarchy& hierarchy) {
  struct Candidate {
    scene::PrimitiveName name;
    const std::int32_t* corners;  // the triangle's row in its mesh
  };
  std::vector<Candidate> candidates;
  for (const std::uint32_t primitive : find_candidates(cutter, hierarchy)) {
    const scene::PrimitiveName name = hierarchy.name(primitive);
    const scene::MeshArrays& mesh = hierarchy.arrays[static_cast<std::size_t>(name.mesh)];
    candidates.push_back({name, mesh.triangles + 3 * std::int64_t{name.triangle}});
    __builtin_prefetch(candidates.back().corners);
  }
  const auto corner = [&](const Candidate& c, int i) {
    return hierarchy.arrays[static_cast<std::size_t>(c.name.mesh)].vertices +
           3 * std::int64_t{c.corners[i]};
  };
  scene::CutCollector collector(cutter, candidates.size());
  fetching_ahead(
      candidates.size(),
      [&](std::size_t i) {
        for (int c = 0; c < 3; ++c) {  // a row may lie on two cache lines
          __builtin_prefetch(corner(candidates[i], c));
          __builtin_prefetch(corner(candidates[i], c) + 2);
        }
      },
      [&](std::size_t i) {
        const Candidate& c = candidates[i];
        collector.add({Vec3(corner(c, 0)), Vec3(corner(c, 1)), Vec3(corner(c, 2))}, c.name.mesh,
                      c.name.triangle);
      });
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
