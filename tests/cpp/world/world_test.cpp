// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/world.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bathyal/world/generate/solids.hpp"
#include "bathyal/world/materials.hpp"

namespace bathyal {
namespace {

constexpr double kTight = 1e-12;  // [m], of 100 m

/// A square of 2 · half, z = slope · x, in cells of 1 m.
TriangleMesh plane(int half, double slope = 0.0) {
  const int side = 2 * half + 1;
  PointMatrix vertices(side * side, 3);
  for (int i = 0; i < side * side; ++i) {
    const double x = i % side - half;
    vertices.row(i) << x, i / side - half, slope * x;
  }
  TriangleMatrix triangles(8 * half * half, 3);
  for (int i = 0; i < 4 * half * half; ++i) {
    const int low = i / (2 * half) * side + i % (2 * half);
    triangles.row(2 * i) << low, low + 1, low + side + 1;
    triangles.row(2 * i + 1) << low, low + side + 1, low + side;
  }
  return TriangleMesh(vertices, triangles);
}

Pose moved(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Vec3(x, y, z);
  return pose;
}

/// Height of what is met from above.
double height(const Scene& scene, double x, double y) {
  return 100.0 - scene.cast(Vec3(x, y, 100.0), -Vec3::UnitZ()).range;
}

double lowest(const TriangleMesh& mesh) { return mesh.vertices().col(2).minCoeff(); }

double highest(const TriangleMesh& mesh) { return mesh.vertices().col(2).maxCoeff(); }

/// What is said about a mistake.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(World, ObjectsAreAddedWithTheirSurface) {
  const auto painted = std::make_shared<const std::vector<std::int16_t>>(8, std::int16_t{3});
  World world;
  const WorldObject object{"bottom", plane(1), moved(0, 0, 2), 2.0, {1, painted}};
  EXPECT_EQ(world.add(object), 0);
  EXPECT_NEAR(height(world.at().scene, 0.3, 0.4), 2.0, kTight);
  const WorldSnapshot now = world.at();
  EXPECT_EQ(now.material(now.scene.cast(Vec3(0.3, 0.4, 9.0), -Vec3::UnitZ())), 3);

  const auto said = [&](const auto& change) {
    WorldObject other = object;
    other.name = "other";
    change(other);
    return refusal([&] { world.add(other); });
  };
  EXPECT_NE(said([](WorldObject& o) { o.name = "bottom"; }).find("`name`"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) { o.name.clear(); }).find("`name`"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) { o.scale = 0.0; }).find("`scale`"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) { o.surface.whole = 99; }).find("got 99"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) { o.surface.whole = -1; }).find("got -1"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) { o.mesh = plane(2); }).find("`surface`"), std::string::npos);
  EXPECT_NE(said([](WorldObject& o) {
              o.surface.of_triangle =
                  std::make_shared<const std::vector<std::int16_t>>(8, std::int16_t{99});
            }).find("got 99"),
            std::string::npos);
  EXPECT_EQ(world.objects().size(), 1U);
}

TEST(World, ObjectsAreRowsOfTheSceneWithTheirMaterials) {
  World world;
  EXPECT_EQ(world.add(plane(5), {}, "mud", "bottom"), 0);
  EXPECT_EQ(world.add(plane(1), moved(2, 0, 3), "steel", "plate", 0.5), 1);
  const WorldSnapshot now = world.at();
  const RayHit above = now.scene.cast(Vec3(2.2, 0.1, 10), -Vec3::UnitZ());
  EXPECT_EQ(above.mesh, 1);
  EXPECT_EQ(above.range, 7.0);
  EXPECT_EQ((*now.materials)[static_cast<std::size_t>(now.material(above))].name, "steel");
  const RayHit past = now.scene.cast(Vec3(2.7, 0.1, 10), -Vec3::UnitZ());  // half as wide
  EXPECT_EQ(past.mesh, 0);
  EXPECT_EQ((*now.materials)[static_cast<std::size_t>(now.material(past))].name, "mud");
  EXPECT_EQ(now.material(now.scene.cast(Vec3(50, 0, 1), -Vec3::UnitZ())), -1);
}

TEST(World, MovingObjectIsMetWhereItIs) {
  World world;
  world.add(plane(20), {}, "sand", "bottom");
  const std::vector<Pose> ends = {moved(-10, 0, 2), moved(10, 0, 2)};
  world.add(plane(1), Trajectory({0.0, 10.0}, ends), "steel", "plate");
  world.add(plane(1), Motion([](double time) { return moved(0, time, 4); }), "steel", "other");
  EXPECT_TRUE(world.moves());
  for (const double time : {0.0, 2.5, 5.0, 10.0}) {
    const Scene scene = world.at(time).scene;
    EXPECT_NEAR(height(scene, -9.9 + 2.0 * time, -0.7), 2.0, kTight) << time;
    EXPECT_NEAR(height(scene, 0.3, time + 0.6), 4.0, kTight) << time;
    EXPECT_NEAR(height(scene, -15.2, -15.7), 0.0, kTight) << time;
  }
}

TEST(World, BuildsNothingAgainWhileItRests) {
  World world;
  world.add(plane(3), {}, "sand", "bottom");
  world.add(plane(1), moved(0, 0, 1), "rock", "plate");
  const WorldSnapshot first = world.at(0.0);
  const WorldSnapshot later = world.at(7.0);
  EXPECT_EQ(later.time, 7.0);
  EXPECT_EQ(first.scene.meshes().data(), later.scene.meshes().data());
  // What is added afterwards is in the next snapshot and not in the last.
  world.add(plane(1), moved(0, 0, 2), "rock", "roof");
  EXPECT_NEAR(height(world.at().scene, 0.2, 0.3), 2.0, kTight);
  EXPECT_NEAR(height(first.scene, 0.2, 0.3), 1.0, kTight);
}

TEST(World, CopiesGoTheirOwnWays) {
  World world;
  world.add(plane(3), {}, "sand", "bottom");
  EXPECT_NEAR(height(world.at().scene, 0.2, 0.3), 0.0, kTight);
  World copy = world;
  copy.add(plane(1), moved(0, 0, 1), "rock", "plate");
  EXPECT_NEAR(height(copy.at().scene, 0.2, 0.3), 1.0, kTight);
  EXPECT_NEAR(height(world.at().scene, 0.2, 0.3), 0.0, kTight);
  world = copy;
  EXPECT_NEAR(height(world.at().scene, 0.2, 0.3), 1.0, kTight);
  EXPECT_EQ(world.row_of("plate"), 1);
}

TEST(World, ThreadsMayAskAtOnce) {
  World world;
  world.add(plane(20), {}, "sand", "bottom");
  world.add(plane(1), Motion([](double time) { return moved(time, 0, 2); }), "steel", "plate");
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&world, &wrong, k] {
      for (int i = 0; i < 10; ++i) {
        const double time = i + 0.1 * k;
        if (std::abs(height(world.at(time, 1).scene, time + 0.3, 0.6) - 2.0) > kTight) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(World, FunctionOfTimeMayAskTheWorldWithoutIt) {
  World ground;
  ground.add(plane(5, 0.5), {}, "sand", "bottom");
  World world = ground;
  world.add(plane(1), Motion([&ground](double time) {
              return moved(time, 0, height(ground.at(time).scene, time, 0) + 3.0);
            }),
            "steel", "plate");
  EXPECT_NEAR(height(world.at(2.0).scene, 2.3, 0.6), 4.0, 1e-12);
}

TEST(World, RefusesByName) {
  World world;
  EXPECT_TRUE(has(refusal([&] { world.at(); }), "`world`: expected one object or more"));
  world.add(plane(1), {}, "sand", "bottom");
  EXPECT_TRUE(has(refusal([&] { world.add(plane(1), {}, "sand", "bottom"); }), "not taken"));
  EXPECT_TRUE(has(refusal([&] { world.add(plane(1), {}, "cheese"); }), "one of rock, gravel"));
  EXPECT_TRUE(has(refusal([&] { world.add(plane(1), {}, "sand", "a", 0.0); }), "`scale`"));
  EXPECT_TRUE(has(refusal([&] { world.at(std::nan("")); }), "`time`"));
  EXPECT_TRUE(has(refusal([&] { (void)world.row_of("wreck"); }), "\"wreck\""));
  EXPECT_EQ(world.objects().size(), 1U);  // nothing of what was refused is in it
  world.add(plane(1), Motion([](double) {
              Pose pose = Pose::Identity();
              pose.linear() *= 2.0;
              return pose;
            }),
            "sand", "swollen");
  EXPECT_TRUE(has(refusal([&] { world.at(); }), "`pose`"));
}

TEST(World, ReplacedMaterialKeepsItsRow) {
  World world;
  Material mine;
  mine.name = "shell";
  mine.strength = 0.3;
  world.set_material(mine);
  const std::int32_t row = world.material_row("shell");
  EXPECT_EQ(static_cast<std::size_t>(row), material_library().size());
  mine.strength = 0.4;
  world.set_material(mine);
  EXPECT_EQ(world.material_row("shell"), row);
  EXPECT_EQ(world.materials().back().strength, 0.4);
  mine.strength = -1.0;
  EXPECT_TRUE(has(refusal([&] { world.set_material(mine); }), "`strength`"));
  mine.strength = 1.0;
  mine.angle = {0.2, 0.1};
  mine.backscatter = {-10.0, -12.0};
  EXPECT_TRUE(has(refusal([&] { world.set_material(mine); }), "rising"));
  EXPECT_EQ(World().materials().size(), material_library().size());
}

TEST(Paint, TakesTrianglesByTheirMiddle) {
  World world;
  world.add(plane(5), moved(100, 0, 0), "sand", "bottom");
  // 4 by 3 cells of two triangles each.
  const std::vector<Eigen::Vector2d> region = {{98, -2}, {102, -2}, {102, 1}, {98, 1}};
  EXPECT_EQ(world.paint("bottom", region, "rock"), 24);
  const WorldSnapshot now = world.at();
  const auto name = [&now](double x, double y) {
    const RayHit hit = now.scene.cast(Vec3(x, y, 5), -Vec3::UnitZ());
    return (*now.materials)[static_cast<std::size_t>(now.material(hit))].name;
  };
  EXPECT_EQ(name(98.1, -1.9), "rock");
  EXPECT_EQ(name(101.9, 0.8), "rock");
  EXPECT_EQ(name(102.1, 0.8), "sand");
  EXPECT_EQ(name(98.1, 1.2), "sand");
  // The later paint is on top; the snapshot from before keeps its own.
  EXPECT_EQ(world.paint("bottom", {{90, -10}, {110, -10}, {110, 10}, {90, 10}}, "mud"), 200);
  EXPECT_EQ(name(98.1, -1.9), "rock");
  EXPECT_TRUE(has(refusal([&] { world.paint("bottom", {{0, 0}, {1, 0}}, "mud"); }), "three"));
  EXPECT_TRUE(has(refusal([&] {
                    world.paint("bottom", {{0, 0}, {1, 0}, {0, std::nan("")}}, "mud");
                  }),
                  "`polygon`"));
  EXPECT_TRUE(has(refusal([&] { world.paint("bottom", region, "cheese"); }), "`material`"));
  EXPECT_TRUE(has(refusal([&] { world.paint("roof", region, "mud"); }), "`object`"));
}

TEST(Clones, LieOnTheGroundUnderTheirOrigin) {
  const TriangleMesh made = make_boulder(1.0);
  PointMatrix vertices = made.vertices();
  vertices.col(2).array() -= 0.7;  // its foot is not at its origin
  const TriangleMesh stone(vertices, TriangleMatrix(made.triangles()));
  for (const double slope : {0.0, 0.3}) {
    World world;
    world.add(plane(20, slope), {}, "sand", "bottom");
    CloneOptions options;
    options.tilt = 0.0;
    options.sunk = 0.2;
    options.scale = {0.5, 2.0};
    options.region = {-10, -5, 10, 5};
    EXPECT_EQ(world.add_clones(stone, 50, "rock", "stone", options), 1);
    for (std::size_t i = 1; i < world.objects().size(); ++i) {
      const WorldObject& object = world.objects()[i];
      const Vec3 at = object.pose.at(0.0).translation();
      EXPECT_LE(std::abs(at.x()), 10.0);
      EXPECT_LE(std::abs(at.y()), 5.0);
      EXPECT_GE(object.scale, 0.5);
      EXPECT_LE(object.scale, 2.0);
      const double tall = object.scale * (highest(stone) - lowest(stone));
      const double foot = at.z() + object.scale * lowest(stone);
      EXPECT_NEAR(foot, slope * at.x() - 0.2 * tall, 1e-9) << i;
      EXPECT_EQ(object.mesh.vertices().data(), world.objects()[1].mesh.vertices().data());
    }
  }
}

TEST(Clones, AreDrawnOneByOne) {
  World ground;
  ground.add(plane(20), {}, "sand", "bottom");
  const TriangleMesh stone = make_boulder(1.0);
  const Scene scene = ground.at().scene;
  CloneOptions options;
  options.seed = 9;
  const std::vector<ClonePlace> few = clone_places(stone, 10, scene, options);
  const std::vector<ClonePlace> many = clone_places(stone, 30, scene, options);
  options.seed = 10;
  const std::vector<ClonePlace> others = clone_places(stone, 10, scene, options);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].world_from_object.matrix(), many[i].world_from_object.matrix());
    EXPECT_EQ(few[i].scale, many[i].scale);
    EXPECT_NE(few[i].scale, others[i].scale);
    const double up = few[i].world_from_object.linear()(2, 2);
    EXPECT_GE(up, std::cos(options.tilt) - 1e-12);
  }
}

TEST(Clones, KeepApart) {
  World ground;
  ground.add(plane(20), {}, "sand", "bottom");
  CloneOptions options;
  options.apart = 3.0;
  const auto places = clone_places(make_boulder(1.0), 60, ground.at().scene, options);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 way =
          places[i].world_from_object.translation() - places[j].world_from_object.translation();
      EXPECT_GE(way.head<2>().norm(), 3.0) << i << ' ' << j;
    }
  }
}

TEST(Clones, RefuseWhatCannotBe) {
  World world;
  world.add(plane(5), {}, "sand", "bottom");
  const TriangleMesh stone = make_boulder(1.0);
  CloneOptions options;
  options.region = {50, 50, 60, 60};
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, 3, "rock", "a", options); }), "0 found"));
  options.region = {1, 0, 0, 1};
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, 3, "rock", "a", options); }), "`region`"));
  options.region.reset();
  options.apart = 5.0;
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, 99, "rock", "a", options); }), "`count`"));
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, 1, "cheese", "a"); }), "`material`"));
  EXPECT_TRUE(has(refusal([&] { world.add_clones(TriangleMesh(), 1, "rock", "a"); }), "`mesh`"));
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, -1, "rock", "a"); }), "`count`"));
  // One name that is taken, and none of them is added.
  world.add(stone, {}, "rock", "a_1");
  EXPECT_TRUE(has(refusal([&] { world.add_clones(stone, 3, "rock", "a"); }), "\"a_1\""));
  EXPECT_EQ(world.objects().size(), 2U);
}

}  // namespace
}  // namespace bathyal
