// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "bathyal/geometry/mesh_report.hpp"
#include "bathyal/world/generate/fish_paths.hpp"
#include "bathyal/world/generate/internal/laying.hpp"
#include "bathyal/world/generate/internal/plate.hpp"
#include "bathyal/world/generate/pipeline.hpp"
#include "bathyal/world/generate/solids.hpp"

namespace bathyal {
namespace {

SeabedOptions all_parts() {
  SeabedOptions options;
  options.seed = 3;
  options.ripple_height = 0.05;
  options.ripple_cover = 0.5;
  options.boulder_density = 0.05;
  options.trench_depth = 1.0;
  options.cliff_height = 2.0;
  options.edge_meander = 0.4;
  options.scour_points = {Vec2(1.0, 2.0)};
  return options;
}

TEST(Seabed, VertexHasTheBytesOfTheHeightThere) {
  const SeabedModel model(all_parts());
  const TriangleMesh mesh = model.mesh(Vec2(12.0, 8.0), 0.25, Vec2(-3.0, 5.3));
  Values::Matrix x(mesh.vertex_count()), y(mesh.vertex_count());
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    x(i) = mesh.vertices()(i, 0);
    y(i) = mesh.vertices()(i, 1);
  }
  const Values places_x(std::move(x)), places_y(std::move(y));
  const Values height = model.height(places_x, places_y);
  const std::vector<std::int16_t> material = model.material(places_x, places_y);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    ASSERT_EQ(height.data()[i], mesh.vertices()(i, 2));
    ASSERT_EQ(material[static_cast<std::size_t>(i)], mesh.attributes().at("material").data()[i]);
  }
}

TEST(Seabed, TilesShareTheBytesOfTheirBorder) {
  const SeabedModel model(all_parts());
  const TriangleMesh left = model.mesh(Vec2(10.0, 6.0), 0.1, Vec2(-5.0, 0.0));
  const TriangleMesh right = model.mesh(Vec2(10.0, 6.0), 0.1, Vec2(5.0, 0.0));
  for (Index row = 0; row <= 60; ++row) {
    ASSERT_EQ(left.vertices().row(row * 101 + 100), right.vertices().row(row * 101));
  }
}

TEST(Seabed, RefusesWhatIsTooLargeBeforeItAsksForMemory) {
  const SeabedModel model;
  EXPECT_THROW(model.mesh(Vec2(1e6, 1e6), 0.01), std::invalid_argument);
  EXPECT_THROW(model.mesh(Vec2(1.0, 1.0), std::numeric_limits<double>::denorm_min()),
               std::invalid_argument);
  EXPECT_THROW(model.mesh(Vec2(1.0, std::nan("")), 0.1), std::invalid_argument);
}

TEST(Hang, IsTheLeastLineOverTheBottomThatBendsNoMore) {
  const std::vector<double> along{0.0, 1.0, 2.0, 3.0, 4.0};
  const std::vector<double> rest{0.0, -9.0, -9.0, -9.0, 0.0};
  const std::vector<double> line = generate::hang(along, rest, 4.0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_NEAR(line[i], (std::pow(along[i] - 2.0, 2) - 4.0) / 8.0, 1e-15);
  }
  EXPECT_EQ(generate::hang(along, rest, std::numeric_limits<double>::infinity()),
            std::vector<double>(5, 0.0));
  EXPECT_EQ(generate::hang({0.0, 1.0}, {3.0, 1.0}, 1.0), (std::vector<double>{3.0, 1.0}));
}

TEST(Plate, WithHolesIsClosedAndNoTwoSquaresTouchByACorner) {
  generate::SquareMask mask(4, 3);
  mask.set(0, 0, false);
  mask.set(1, 1, false);
  mask.set(2, 0, false);
  mask.join_corners();
  std::vector<Vec3> top, bottom;
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 4; ++i) {
      top.emplace_back(i, j, 0.5);
      bottom.emplace_back(i, j, 0.0);
    }
  }
  generate::MeshBuilder builder;
  add_plate(builder, mask, top, bottom);
  const MeshReport report = mesh_report(builder.mesh());
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.nonmanifold_edges, 0);
  EXPECT_EQ(report.nonmanifold_vertices, 0);
  double squares = 0.0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) squares += mask.at(i, j) ? 1.0 : 0.0;
  }
  EXPECT_LT(squares, 12.0);
  EXPECT_NEAR(report.volume, 0.5 * squares, 1e-12);
}

TEST(Bodies, AreClosedForEverySeed) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    WreckOptions options;
    options.seed = seed;
    options.holes = 20;
    options.spacing = 1.0;
    const MeshReport wreck = mesh_report(make_wreck(50.0, options));
    EXPECT_TRUE(wreck.closed) << seed;
    EXPECT_EQ(wreck.nonmanifold_vertices, 0) << seed;
    EXPECT_GT(mesh_report(make_boulder(1.0, {seed, 0.2, 2})).volume, 4.188);
  }
}

TEST(Pipeline, OnASeabedIsClosedAndFishKeepOffIt) {
  const TriangleMesh bottom = make_seabed(Vec2(40.0, 40.0), 0.5, all_parts());
  PipelineOptions options;
  options.spans = {{10.0, 20.0}};
  options.burial = {0.1, 0.6};
  const Pipeline pipe =
      make_pipeline({Vec2(-18.0, -4.0), Vec2(18.0, 9.0)}, Scene({bottom}), 0.5, options);
  EXPECT_TRUE(mesh_report(pipe.mesh).closed);
  const Scene scene({bottom, pipe.mesh});
  for (const Trajectory& path : fish_paths(scene, 5, 60.0)) {
    for (const Pose& pose : path.pose()) {
      EXPECT_GE(scene.nearest(pose.translation()).distance, 0.5);
    }
  }
}

}  // namespace
}  // namespace bathyal
