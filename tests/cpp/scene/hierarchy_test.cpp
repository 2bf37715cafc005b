// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/hierarchy.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "bathyal/scene/internal/cells.hpp"
#include "bathyal/scene/internal/nearness.hpp"
#include "bathyal/scene/internal/slab_filter.hpp"
#include "bathyal/scene/internal/split.hpp"
#include "meshes.hpp"

namespace bathyal {
namespace {

/// Every triangle is in exactly one block, every block hangs in exactly one lane, children come
/// after their parent, and each box holds what is below it.
void check_structure(const Scene::Hierarchy& h) {
  std::vector<int> triangle_seen(h.primitive_count);
  std::vector<int> block_seen(h.blocks.size());
  std::vector<int> node_seen(h.nodes.size());
  for (std::size_t n = 0; n < h.nodes.size(); ++n) {
    for (int lane = 0; lane < scene::kWidth; ++lane) {
      const std::int32_t child = h.nodes[n].child[lane];
      if (child == scene::kNoChild) {
        EXPECT_GT(h.nodes[n].low[0][lane], h.nodes[n].high[0][lane]);
        continue;
      }
      if (child >= 0) {
        ASSERT_GT(child, static_cast<std::int32_t>(n));
        ++node_seen[static_cast<std::size_t>(child)];
        for (int inner = 0; inner < scene::kWidth; ++inner) {
          if (h.nodes[child].child[inner] == scene::kNoChild) continue;
          for (int axis = 0; axis < 3; ++axis) {
            ASSERT_LE(h.nodes[n].low[axis][lane], h.nodes[child].low[axis][inner]);
            ASSERT_GE(h.nodes[n].high[axis][lane], h.nodes[child].high[axis][inner]);
          }
        }
        continue;
      }
      ++block_seen[static_cast<std::size_t>(~child)];
      const scene::TriangleBlock& block = h.blocks[~child];
      for (const std::uint32_t primitive : block.primitive) {
        if (primitive == scene::kNoPrimitive) continue;
        ++triangle_seen[primitive];
        for (const Vec3& corner : h.corners(primitive)) {
          for (int axis = 0; axis < 3; ++axis) {
            const double x = corner[axis] - h.origin[axis];
            ASSERT_LE(h.nodes[n].low[axis][lane], x);
            ASSERT_GE(h.nodes[n].high[axis][lane], x);
          }
        }
      }
    }
  }
  for (const int seen : triangle_seen) ASSERT_EQ(seen, 1);
  for (const int seen : block_seen) ASSERT_EQ(seen, 1);
  for (std::size_t n = 1; n < node_seen.size(); ++n) ASSERT_EQ(node_seen[n], 1);
}

TEST(Hierarchy, HoldsEveryTriangleOnceInBoxesThatContainIt) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(6.2e5, 7.2e6, -50)}) {
    check_structure(Scene::Hierarchy({test::seabed(160, 140, offset)}, 2));
    check_structure(Scene::Hierarchy({test::sphere(4, 2.0, offset)}, 2));
    check_structure(Scene::Hierarchy({test::box(Vec3(1, 2, 3), offset)}, 2));
  }
}

TEST(Hierarchy, IsTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::seabed(200, 200, Vec3(6.2e5, 7.2e6, -50));
  const Scene::Hierarchy one({mesh}, 1);
  const Scene::Hierarchy eight({mesh}, 8);
  ASSERT_EQ(one.nodes.size(), eight.nodes.size());
  ASSERT_EQ(one.blocks.size(), eight.blocks.size());
  EXPECT_EQ(std::memcmp(one.nodes.data(), eight.nodes.data(), one.nodes.bytes()), 0);
  EXPECT_EQ(std::memcmp(one.blocks.data(), eight.blocks.data(), one.blocks.bytes()), 0);
}

TEST(Hierarchy, TakesAtMostSeventyBytesATriangle) {
  for (const TriangleMesh& mesh : {test::seabed(320, 320, Vec3(0, 0, 0)), test::sphere(6, 5.0)}) {
    const Scene::Hierarchy hierarchy({mesh}, 2);
    EXPECT_LE(hierarchy.memory(), 70U * static_cast<std::size_t>(mesh.triangle_count()));
  }
}

TEST(Hierarchy, CrowdedCellsCoincidentAndDegenerateTriangles) {
  // One far triangle makes one cell of all the others.
  TriangleMesh mesh = test::seabed(200, 200, Vec3(0, 0, 0));
  check_structure(Scene::Hierarchy({mesh, test::one_triangle(Vec3(1e7, -1e7, 1e6))}, 2));
  // Nothing separates copies.
  TriangleMatrix copies(40000, 3);
  for (Index i = 0; i < copies.rows(); ++i) copies.row(i) << 0, 1, 2;
  check_structure(Scene::Hierarchy(
      {TriangleMesh(test::one_triangle(Vec3(1, 2, 3)).shared_vertices(), copies)}, 2));
  TriangleMatrix points(9, 3);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) << 1, 1, 1;
  check_structure(Scene::Hierarchy(
      {TriangleMesh(test::one_triangle(Vec3(1, 2, 3)).shared_vertices(), points)}, 2));
}

TEST(Hierarchy, ManyMeshesAndEmptyOnesNameTheirTriangles) {
  const TriangleMesh empty(Points{}, Triangles{});
  const Scene::Hierarchy h(
      {empty, test::one_triangle(Vec3(0, 0, 0)), empty, test::box(Vec3(1, 1, 1)), empty}, 1);
  EXPECT_EQ(h.primitive_count, 13U);
  EXPECT_EQ(h.name(0).mesh, 1);
  EXPECT_EQ(h.name(1).mesh, 3);
  EXPECT_EQ(h.name(1).triangle, 0);
  EXPECT_EQ(h.name(12).triangle, 11);
  check_structure(h);
  EXPECT_EQ(Scene::Hierarchy({empty}, 1).nodes.size(), 0U);
}

TEST(Hierarchy, RefusesWhatFloatCannotHold) {
  const TriangleMesh far[] = {test::one_triangle(Vec3(0, 0, 0)),
                              test::one_triangle(Vec3(3e12, 0, 0))};
  EXPECT_THROW(Scene::Hierarchy({far[0], far[1]}, 1), std::invalid_argument);
  EXPECT_THROW(Scene::Hierarchy({far[0]}, -1), std::invalid_argument);
}

TEST(Cells, HoldEveryTriangleOnceForAnyNumberOfThreads) {
  const Scene scene({test::seabed(60, 60)});
  const Scene::Hierarchy& h = scene.hierarchy();
  const scene::SortedBoxes one = scene::sort_into_cells(h, 1), four = scene::sort_into_cells(h, 4);
  std::vector<int> seen(h.primitive_count);
  std::uint32_t next = 0;
  for (const scene::Cell& cell : one.cells) {
    EXPECT_EQ(cell.first, next);
    next += cell.count;
    for (std::uint32_t i = cell.first; i < next; ++i) ++seen[one.items[i].second_tag()];
  }
  EXPECT_EQ(next, h.primitive_count);
  for (const int count : seen) ASSERT_EQ(count, 1);
  ASSERT_EQ(one.items.bytes(), four.items.bytes());
  EXPECT_EQ(std::memcmp(one.items.data(), four.items.data(), one.items.bytes()), 0);

  std::vector<scene::BinaryNode> nodes(1);
  std::vector<scene::Box> items(one.items.begin(), one.items.end());
  scene::split_by_area(items.data(), 0, h.primitive_count, 8, nodes, 0);
  std::uint32_t in_leaves = 0;
  for (const scene::BinaryNode& node : nodes) {
    if (!node.is_leaf()) continue;
    EXPECT_LE(node.item_count(), 8U);
    in_leaves += node.item_count();
  }
  EXPECT_EQ(in_leaves, h.primitive_count);
}

/// The exact extremes of direction · (x − anchor) over a triangle.
std::array<double, 2> extent(const std::array<Vec3, 3>& corners, const Vec3& direction,
                             const Vec3& anchor) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (const Vec3& corner : corners) {
    const double x = direction.dot(corner - anchor);
    range = {std::min(range[0], x), std::max(range[1], x)};
  }
  return range;
}

TEST(Culling, NeverRulesOutWhatLiesInReach) {
  const Scene scene({test::seabed(40, 40, Vec3(431200, 6172650, -38))});
  const Scene::Hierarchy& h = scene.hierarchy();
  const Vec3 direction = Vec3(0.6, 0.7, -0.2).normalized(), anchor(431217.3, 6172661.9, -37.2);
  const Vec3 query(431221.7, 6172644.2, -30.1);
  const scene::SlabFilter slab(h, direction, anchor, 5.0, 0.0);
  const scene::Nearness nearness(h, query - h.origin);
  int kept = 0, lanes = 0;
  for (std::size_t b = 0; b < h.blocks.size(); ++b) {
    const unsigned in_slab = slab.filter(h.blocks[b]).bits();
    scene::LaneDistances bounds;
    nearness.bound(h.blocks[b], bounds);
    for (int lane = 0; lane < scene::kWidth; ++lane) {
      const std::uint32_t primitive = h.blocks[b].primitive[lane];
      if (primitive == scene::kNoPrimitive) continue;
      const auto corners = h.corners(primitive);
      const auto [low, high] = extent(corners, direction, anchor);
      const bool is_kept = (in_slab >> lane & 1U) != 0;
      EXPECT_TRUE(is_kept || low > 5.0 || high < 0.0);
      kept += static_cast<int>(is_kept);
      ++lanes;
      for (const Vec3& corner : corners) {
        EXPECT_LE(bounds[static_cast<std::size_t>(lane)], nearness.limit((corner - query).norm()));
      }
    }
  }
  EXPECT_LT(kept, lanes / 2) << "the slab holds a part of the seabed only";
}

}  // namespace
}  // namespace bathyal
