// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/shape.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bathyal {
namespace {

TEST(Shape, MayBeFlatAndMirrored) {
  Shape plate;
  plate.size = Vec3(1.0, 2.0, 0.0);
  EXPECT_NO_THROW(plate.check());
  Shape mesh;
  mesh.kind = ShapeKind::kMesh;
  mesh.file = "hand.stl";
  mesh.scale = Vec3(1e-3, -1e-3, 1e-3);
  EXPECT_NO_THROW(mesh.check());
}

TEST(Shape, RefusesWhatNoBodyHas) {
  for (const double bad : {-1.0, static_cast<double>(INFINITY), static_cast<double>(NAN)}) {
    Shape box, cylinder, longer;
    box.size.y() = bad;
    cylinder.radius = bad;
    longer.length = bad;
    EXPECT_THROW(box.check(), std::invalid_argument);
    EXPECT_THROW(cylinder.check(), std::invalid_argument);
    EXPECT_THROW(longer.check(), std::invalid_argument);
  }
  Shape nameless;
  nameless.kind = ShapeKind::kMesh;
  EXPECT_THROW(nameless.check(), std::invalid_argument);
  nameless.file = "hand.stl";
  nameless.scale.z() = 0.0;
  EXPECT_THROW(nameless.check(), std::invalid_argument);
  Shape stretched;
  stretched.body_from_shape.linear() *= 2.0;
  EXPECT_THROW(stretched.check(), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
