// SPDX-License-Identifier: BSD-3-Clause
#include <bathyal/scene/scene.hpp>
#include <cmath>

int main() {
  bathyal::PointMatrix corners(3, 3);
  corners << -1, -1, -5, 2, -1, -5, -1, 2, -5;
  const bathyal::TriangleMesh bottom(corners, bathyal::TriangleMatrix{{0, 1, 2}});
  const bathyal::Scene scene({bottom});
  const bathyal::RayHit hit = scene.cast(bathyal::Vec3(0, 0, 0), bathyal::Vec3(0, 0, -1));
  return std::abs(hit.range - 5.0) < 1e-12 && hit.triangle == 0 ? 0 : 1;
}
