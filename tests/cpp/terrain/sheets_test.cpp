// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/sheets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/terrain/internal/plan_grid.hpp"
#include "bathyal/terrain/internal/sheet_search.hpp"
#include "bathyal/terrain/internal/two_sheets.hpp"

namespace bathyal {
namespace {

using namespace terrain;

using std::numbers::pi;

/// 40 000 soundings over 10 m × 10 m (5 cm apart) on `height`, with noise; `spikes` of them moved
/// by −5 to 10 m.
std::vector<Vec3> ground(std::uint64_t seed, const std::function<double(double, double)>& height,
                         double noise, double spikes = 0.0) {
  RandomStream draw(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 40000; ++i) {
    const double x = draw.uniform(0, 10), y = draw.uniform(0, 10);
    const double spike = draw.uniform() < spikes ? draw.uniform(-5, 10) : 0.0;
    points.emplace_back(x, y, height(x, y) + noise * draw.normal() + spike);
  }
  return points;
}

/// `count` soundings on the roof low ≤ (x, y) ≤ high at `z`.
void add_roof(std::vector<Vec3>& points, std::uint64_t seed, int count, const Vec3& low,
              const Vec3& high, double noise) {
  RandomStream draw(seed, 1);
  for (int i = 0; i < count; ++i) {
    points.emplace_back(draw.uniform(low.x(), high.x()), draw.uniform(low.y(), high.y()),
                        low.z() + noise * draw.normal());
  }
}

SheetReport find(const std::vector<Vec3>& points, const FindSheetsOptions& options = {},
                 const Vec3& offset = Vec3::Zero()) {
  PointMatrix matrix(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    matrix.row(static_cast<Index>(i)) = points[i] + offset;
  return find_sheets(Points(matrix).view(), options);
}

double flat(double, double) { return 0.0; }

struct Ground {
  const char* name;
  std::function<double(double, double)> height;
  double noise, spikes;
};

// Each is single-valued: not one of them may be reported as several sheets.
const std::vector<Ground> kSingleValued = {
    {"noise as large as the spacing", flat, 0.05, 0.0},
    {"smooth", flat, 0.0, 0.0},
    {"sand waves", [](double x, double) { return 0.5 * std::sin(2.0 * x); }, 0.02, 0.0},
    {"80 degree wall", [](double x, double) { return std::clamp((x - 5) * 5.671, 0.0, 3.0); }, 0.02,
     0.0},
    {"winding cliff", [](double x, double y) { return x + 0.3 * std::sin(3 * y) < 5 ? 0.0 : 4.0; },
     0.02, 0.0},
    {"steps", [](double x, double) { return 0.5 * std::floor(x); }, 0.02, 0.0},
    {"boulders with steep flanks",
     [](double x, double y) {
       const double r = 0.3, dx = std::fmod(x, 0.9) - 0.45, dy = std::fmod(y, 0.9) - 0.45;
       return 3.0 * std::sqrt(std::max(0.0, r * r - dx * dx - dy * dy));
     },
     0.01, 0.0},
    {"fins", [](double x, double) { return std::fmod(x, 1.0) < 0.1 ? 1.0 : 0.0; }, 0.01, 0.0},
    {"checkerboard of blocks",
     [](double x, double y) { return std::fmod(std::floor(x * 2.5) + std::floor(y * 2.5), 2.0); },
     0.01, 0.0},
    {"1 % spikes", [](double x, double) { return 0.2 * std::sin(x); }, 0.02, 0.01},
    {"10 % spikes", [](double x, double) { return 0.2 * std::sin(x); }, 0.02, 0.1},
    {"30 % spikes", [](double x, double) { return 0.2 * std::sin(x); }, 0.02, 0.3},
};

TEST(FindSheets, IsSilentOnSteepSteppedNoisyAndSpikyGround) {
  for (const Ground& g : kSingleValued) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const SheetReport report = find(ground(seed, g.height, g.noise, g.spikes));
      EXPECT_TRUE(report.single_valued()) << g.name << ": " << describe(report);
    }
  }
}

TEST(FindSheets, IsSilentOnAWallWithSoundingsAllTheWayUp) {
  for (const double degrees : {80.0, 90.0}) {
    const double run = 4.0 / std::tan(degrees * pi / 180.0);
    std::vector<Vec3> points;
    for (const Vec3& p : ground(1, flat, 0.02)) {
      if (p.x() < 5.0) points.push_back(p);
      if (p.x() > 5.0 + run) points.emplace_back(p.x(), p.y(), p.z() + 4.0);
    }
    RandomStream draw(2);
    for (int i = 0; i < 16000; ++i) {
      const double z = draw.uniform(0, 4);
      points.emplace_back(5.0 + run * z / 4.0 + 0.01 * draw.normal(), draw.uniform(0, 10), z);
    }
    EXPECT_TRUE(find(points).single_valued()) << degrees;
  }
}

TEST(FindSheets, FindsALedgeWhereItIs) {
  for (const double noise : {0.0, 0.02, 0.05}) {
    std::vector<Vec3> points = ground(3, flat, noise);
    add_roof(points, 3, 1200, {3, 6, 0.8}, {4, 9, 0}, noise);
    const SheetReport report = find(points, {}, {620000, 7246000, -50});
    ASSERT_EQ(report.patches.size(), 1U) << noise;
    const SheetPatch& patch = report.patches.front();
    EXPECT_NEAR(patch.separation, 0.8, 0.03);
    EXPECT_NEAR(patch.area, 3.0, 0.6);
    EXPECT_NEAR(report.share(), 0.03, 0.006);
    EXPECT_LT((patch.low - Vec3(620003, 7246006, -50)).norm(), 0.35);
    EXPECT_LT((patch.high - Vec3(620004, 7246009, -49.2)).norm(), 0.35);
    for (Index i = 0; i < report.cells.rows(); ++i) {
      EXPECT_NEAR(report.cells(i, 0), 620003.5, 0.65);
      EXPECT_NEAR(report.cells(i, 1), 7246007.5, 1.65);
      EXPECT_NEAR(report.cells(i, 2), -49.6, 0.25);
    }
  }
}

TEST(FindSheets, FindsAnArchAPipeAndASphere) {
  RandomStream draw(4);
  std::vector<Vec3> arch = ground(4, flat, 0.02), pipe = arch, sphere;
  for (int i = 0; i < 8000; ++i) {
    const double t = draw.uniform(0, pi), y = draw.uniform(4.5, 5.5);
    const double r = draw.uniform() < 0.5 ? 2.0 : 2.4;
    arch.emplace_back(5 + r * std::cos(t), y, r * std::sin(t));
    const double u = draw.uniform(0, 2 * pi);  // half buried, its underside in the ground
    pipe.emplace_back(draw.uniform(0, 10), 5 + 0.3 * std::cos(u), 0.15 + 0.3 * std::sin(u));
    const Vec3 v(draw.normal(), draw.normal(), draw.normal());
    sphere.push_back(v.normalized());
  }
  EXPECT_GT(find(arch).share(), 0.03);
  EXPECT_GT(find(pipe).share(), 0.04);
  EXPECT_GT(find(sphere).share(), 0.5);
}

TEST(FindSheets, ReportsPassesThatDisagreeByClearlyMoreThanTheirNoise) {
  const auto waves = [](double x, double) { return 0.3 * std::sin(x); };
  const auto two_passes = [&](double step) {
    std::vector<Vec3> points = ground(5, waves, 0.02);
    for (const Vec3& p : ground(6, waves, 0.02)) points.push_back(p + Vec3(0, 0, step));
    return find(points);
  };
  EXPECT_TRUE(two_passes(0.05).single_valued());
  EXPECT_GT(two_passes(0.3).share(), 0.5);
  EXPECT_NEAR(two_passes(0.3).patches.front().separation, 0.3, 0.01);
}

TEST(FindSheets, IsBlindBelowTheSeparationAsked) {
  std::vector<Vec3> points = ground(7, flat, 0.01);
  add_roof(points, 7, 1200, {3, 6, 0.8}, {4, 9, 0}, 0.01);
  EXPECT_FALSE(find(points, {.min_separation = 0.7}).single_valued());
  EXPECT_TRUE(find(points, {.min_separation = 0.9}).single_valued());
  EXPECT_TRUE(find(points, {.min_points = 5000}).single_valued());
}

TEST(FindSheets, IsTheSameForAnyNumberOfThreads) {
  std::vector<Vec3> points = ground(8, flat, 0.03);
  add_roof(points, 8, 3000, {1, 1, 0.8}, {6, 3, 0}, 0.03);
  const SheetReport one = find(points, {.num_threads = 1});
  const SheetReport eight = find(points, {.num_threads = 8});
  EXPECT_EQ(one.cells, eight.cells);
  EXPECT_EQ(one.separation, eight.separation);
  ASSERT_EQ(one.patches.size(), eight.patches.size());
  EXPECT_EQ(one.patches.front().point_count, eight.patches.front().point_count);
}

TEST(FindSheets, TakesEveryDegenerateCloud) {
  EXPECT_TRUE(find({}).single_valued());
  EXPECT_TRUE(find({Vec3(1, 2, 3)}).single_valued());
  EXPECT_TRUE(find(std::vector<Vec3>(100, Vec3(1e7, 1e7, 1))).single_valued());
  std::vector<Vec3> line, mast, thin;
  for (int i = 0; i < 1000; ++i) {
    line.emplace_back(0.1 * i, 0, 0.01 * (i % 7));
    mast.emplace_back(5, 5, 0.1 * i);
    thin.emplace_back(1e4 * i, 1e-4 * i, 0.0);
  }
  EXPECT_TRUE(find(line).single_valued());
  EXPECT_TRUE(find(mast).single_valued());
  EXPECT_TRUE(find(thin).single_valued());
  EXPECT_THROW(find({Vec3(1, 2, NAN)}), std::invalid_argument);
  EXPECT_THROW(find(std::vector<Vec3>(100, Vec3(1e80, 1, 1))), std::invalid_argument);
}

TEST(FindSheets, ASlantedTrackCostsOnlyTheCellsThatItCovers) {
  RandomStream draw(9);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i) {
    const double t = draw.uniform(0, 5000), w = draw.uniform(-3, 3);
    points.emplace_back(0.7 * t + 0.7 * w, 0.7 * t - 0.7 * w, 0.02 * draw.normal());
  }
  const SheetReport report = find(points);
  EXPECT_TRUE(report.single_valued());
  EXPECT_NEAR(report.covered_area, 0.98 * 5000 * 6, 0.35 * 5000 * 6);
}

TEST(FindSheets, ChecksItsOptions) {
  EXPECT_THROW(find({}, {.min_separation = -1.0}), std::invalid_argument);
  EXPECT_THROW(find({}, {.min_points = 4}), std::invalid_argument);
  EXPECT_THROW(find({}, {.num_threads = -1}), std::invalid_argument);
}

PointMatrix matrix_of(const std::vector<Vec3>& points) {
  PointMatrix matrix(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) matrix.row(static_cast<Index>(i)) = points[i];
  return matrix;
}

TEST(PlanGrid, PutsEveryPointIntoItsCellAndFindsTheCellsAround) {
  const PointMatrix points = matrix_of(ground(
      3, [](double, double) { return 0.0; }, 0.0));
  const PlanGrid grid(PointView(points.data(), points.rows(), 3), 4.0);
  ASSERT_EQ(grid.points().size(), 40000U);
  std::size_t next = 0;
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    const PlanGrid::Cell& cell = grid.cells()[i];
    ASSERT_EQ(cell.begin, next);
    next = cell.end;
    const auto [x, y] = grid.centre(cell);
    for (std::size_t p = cell.begin; p < cell.end; ++p) {
      ASSERT_LE(std::abs(grid.points()[p].x - x), 0.500001 * grid.cell_size());
      ASSERT_LE(std::abs(grid.points()[p].y - y), 0.500001 * grid.cell_size());
    }
    std::size_t around = 0, expected = 0;
    for (const auto& run : grid.neighbours(i)) around += run.size();
    if (i % 101 != 0) continue;  // the count below is quadratic
    for (const PlanGrid::Cell& other : grid.cells()) {
      expected += std::abs(other.column - cell.column) <= 1 && std::abs(other.row - cell.row) <= 1;
    }
    ASSERT_EQ(around, expected);
  }
  EXPECT_EQ(next, grid.points().size());
}

TEST(TwoSheets, SplitsTwoPlanesAndLeavesOneWhole) {
  RandomStream draw(8);
  std::vector<PlanGrid::Point> points;
  for (int i = 0; i < 60; ++i) {
    const double x = draw.uniform(-1, 1), y = draw.uniform(-1, 1);
    points.push_back({x, y, 0.3 * x + (i % 3 == 0 ? 2.0 : 0.0) + 0.01 * draw.normal()});
  }
  const TwoSheets split = split_into_sheets(points, 0.5);
  ASSERT_TRUE(split.found);
  EXPECT_TRUE(split.seed);
  EXPECT_NEAR(split.separation, 2.0, 0.02);
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(split.upper[i], i % 3 == 0);
  EXPECT_NEAR(rms_about_sheets(points), 0.01, 0.004);
  EXPECT_FALSE(split_into_sheets(points, 3.0).found);
}

TEST(SheetSearch, MeasuresTheNoiseOfASlope) {
  const PointMatrix points = matrix_of(ground(
      4, [](double x, double y) { return x - y; }, 0.02));
  const PlanGrid grid(PointView(points.data(), points.rows(), 3), 2.25);
  EXPECT_NEAR(measure_noise(grid), 0.02 / std::sqrt(3.0), 0.0015);  // across the slope
}

}  // namespace
}  // namespace bathyal
