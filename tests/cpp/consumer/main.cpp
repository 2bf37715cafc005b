// SPDX-License-Identifier: BSD-3-Clause
#include <bathyal/scene/scene.hpp>
#include <iostream>

int main() {
  bathyal::PointMatrix corners(3, 3);
  corners << -1, -1, -5, 2, -1, -5, -1, 2, -5;
  const bathyal::TriangleMesh bottom(corners, bathyal::TriangleMatrix{{0, 1, 2}});
  const bathyal::Scene scene({bottom});
  const bathyal::RayHit hit = scene.cast(bathyal::Vec3(0, 0, 0), bathyal::Vec3(0, 0, -1));
  std::cout << "triangle " << hit.triangle << " at " << hit.range << " m\n";
}
