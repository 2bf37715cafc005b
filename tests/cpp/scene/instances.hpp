// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

// Scenes of instances, and the same as meshes in the world.

namespace bathyal::test {

/// Meshes at poses, and the same as meshes in the world.
struct Cast {
  std::vector<TriangleMesh> meshes;
  std::vector<Pose> poses;
  std::vector<double> scales;

  void add(const TriangleMesh& mesh, const Pose& pose = Pose::Identity(), double scale = 1.0) {
    meshes.push_back(mesh);
    poses.push_back(pose);
    scales.push_back(scale);
  }
  Scene scene(int num_threads = 2) const { return Scene(meshes, poses, scales, num_threads); }
  Scene merged() const {
    std::vector<TriangleMesh> moved;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      PointMatrix vertices(meshes[i].vertex_count(), 3);
      for (Index v = 0; v < vertices.rows(); ++v) {
        vertices.row(v) =
            poses[i] * Vec3(scales[i] * Vec3(meshes[i].vertices().row(v).transpose()));
      }
      moved.emplace_back(Points(std::move(vertices)), meshes[i].shared_triangles());
    }
    return Scene(std::move(moved), 2);
  }
};

inline Pose random_pose(RandomStream& random, const Vec3& centre, const Vec3& half) {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
          .normalized()
          .toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    pose.translation()[axis] = centre[axis] + half[axis] * random.uniform(-1.0, 1.0);
  }
  return pose;
}

/// A bottom of 60 m × 50 m and stones of two kinds over it, turned and of all sizes.
inline Cast stones(int count, const Vec3& offset, std::uint64_t seed) {
  Cast cast;
  cast.add(seabed(60, 50, offset));
  const TriangleMesh round = sphere(2, 1.0, Vec3(0.2, 0.1, -0.3));
  const TriangleMesh cornered = box(Vec3(0.5, 1.0, 0.8), Vec3(3, 0, 0));
  for (int i = 0; i < count; ++i) {
    RandomStream random(seed, static_cast<std::uint64_t>(i));
    const Pose pose = random_pose(random, offset + Vec3(30, 25, 0.5), Vec3(30, 25, 2));
    cast.add(i % 3 == 0 ? cornered : round, pose, random.uniform(0.2, 1.5));
  }
  return cast;
}

}  // namespace bathyal::test
