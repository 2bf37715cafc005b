// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/sheet.hpp"

#include <gtest/gtest.h>

#include "bottoms.hpp"

namespace bathyal::test {
namespace {

using namespace toolpath;

const Vec3 kUp(0, 0, 1);

// A slope and a level sheet that cross at x = 2, where a target lies on both.
TEST(Sheet, ATargetWhereTwoSheetsCrossIsFollowedOnItsOwn) {
  const TriangleMesh slope = grid([](double x, double) { return x - 2; }, 0, 4, 2, 0, 1, 1);
  const TriangleMesh level = grid([](double, double) { return 0.0; }, 0, 4, 2, 0, 1, 1);
  const SheetPoint crossing{{2, 0.25, 0}, kUp, 0, 0}, on_level{{1, 0.25, 0}, kUp, 0, 0};
  for (const std::int32_t mesh : {0, 1}) {
    const Scene scene(mesh == 0 ? std::vector<TriangleMesh>{level, slope}
                                : std::vector<TriangleMesh>{slope, level});
    SheetPoint a = crossing, b = on_level;
    a.mesh = b.mesh = mesh;
    for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
      const Leg leg = follow_sheet(scene, a, b, kUp);
      ASSERT_EQ(leg.runs.size(), 1U) << "there is no gap on the level sheet";
      double length = 0;
      for (const Piece& piece : leg.runs[0].pieces) {
        EXPECT_EQ(piece.mesh, mesh);
        length += piece.length();
      }
      EXPECT_NEAR(length, 1.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace bathyal::test
