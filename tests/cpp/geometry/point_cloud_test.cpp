// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bathyal/geometry/internal/edge_topology.hpp"
#include "bathyal/geometry/internal/shadow_area.hpp"

namespace bathyal {
namespace {

using namespace geometry;

TEST(PointCloud, SubtractsAWholeNumberOfMetresAndPassesOverWhatIsNotFinite) {
  PointMatrix points(3, 3);
  points << 431200.25, 6172650.75, -38.5, std::nan(""), 9e9, 0.0, 431210.25, 6172660.75, -30.5;
  const Vec3 origin = local_origin(Points(points).view());
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(origin[axis], std::round(origin[axis]));
  EXPECT_LE((origin - Vec3(431205.25, 6172655.75, -34.5)).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_EQ(local_origin(Points(PointMatrix(0, 3)).view()), Vec3::Zero());
}

TEST(PointCloud, RefusesAnAttributeOfAnotherLength) {
  const Values::Matrix two = Values::Matrix::Zero(2);
  EXPECT_THROW(
      PointCloud(Points(PointMatrix(PointMatrix::Zero(3, 3))), {{"intensity", Values(two)}}),
      std::invalid_argument);
}

TEST(SharedArray, KeepsTheMemoryThatItShares) {
  auto owner = std::make_shared<PointMatrix>(PointMatrix::Constant(2, 3, 4.0));
  const double* const data = owner->data();
  const std::weak_ptr<PointMatrix> watched = owner;
  {
    const Points points(data, 2, std::move(owner));
    const Points copy = points;
    EXPECT_EQ(copy.view().data(), data);
    EXPECT_FALSE(watched.expired());
  }
  EXPECT_TRUE(watched.expired());
}

/// Two unit squares, one above a half of the other, that share no vertex.
TriangleMesh overlapping_squares() {
  PointMatrix vertices(8, 3);
  vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, 1, 1.5, 0, 1, 1.5, 1, 1, 0.5, 1, 1;
  TriangleMatrix triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  return {std::move(vertices), std::move(triangles)};
}

TEST(ShadowArea, CountsEveryPlaceOnce) {
  EXPECT_NEAR(shadow_area(overlapping_squares(), 1), 1.5, 1e-3);
}

TEST(EdgeTopology, CountsPiecesRimsAndDuplicates) {
  const TriangleMesh mesh = overlapping_squares();
  const EdgeTopology edges = edge_topology(mesh, 1);
  EXPECT_EQ(edges.components, 2);
  EXPECT_EQ(edges.boundary_edges, 8);
  EXPECT_EQ(edges.inconsistent_edges, 0);
  EXPECT_EQ(edges.boundary_loops, (std::vector<double>{4.0, 4.0}));
  TriangleMatrix repeated(3, 3);
  repeated << 0, 1, 2, 4, 5, 6, 2, 0, 1;
  EXPECT_EQ(count_duplicate_triangles(Triangles(repeated).view(), 8, 1), 1);
}

}  // namespace
}  // namespace bathyal
