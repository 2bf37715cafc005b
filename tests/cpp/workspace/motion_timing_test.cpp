// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/motion_timing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/arms.hpp"

namespace bathyal {
namespace {

JointMatrix rows_of(std::initializer_list<std::initializer_list<double>> rows) {
  JointMatrix q(static_cast<Index>(rows.size()), static_cast<Index>(rows.begin()->size()));
  Index i = 0;
  for (const auto& row : rows) {
    Index k = 0;
    for (const double value : row) q(i, k++) = value;
    ++i;
  }
  return q;
}

/// The largest difference of each order over its limit, at rest before and after.
struct Used {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;
};

Used used(const TimedMotion& motion, const MotionLimits& limits) {
  const Index rows = motion.q.rows(), columns = motion.q.cols();
  JointMatrix padded(rows + 6, columns);
  for (Index i = 0; i < rows + 6; ++i) {
    padded.row(i) = motion.q.row(std::clamp<Index>(i - 3, 0, rows - 1));
  }
  const double step = motion.time[1] - motion.time[0];
  JointMatrix difference = padded;
  const auto next = [&] {
    const Index n = difference.rows() - 1;
    difference = ((difference.bottomRows(n) - difference.topRows(n)) / step).eval();
  };
  const auto share = [&](const std::vector<double>& limit) {
    double most = 0.0;
    for (Index k = 0; k < columns; ++k) {
      most = std::max(most,
                      difference.col(k).cwiseAbs().maxCoeff() / limit[static_cast<std::size_t>(k)]);
    }
    return most;
  };
  Used found;
  next();
  found.velocity = share(limits.velocity);
  next();
  found.acceleration = share(limits.acceleration);
  next();
  found.jerk = share(limits.jerk);
  return found;
}

/// Seven phases from rest to rest over a way h (Biagiotti, Melchiorri 2008, eq. 3.30 and after).
double double_s_duration(double h, double v, double a, double j) {
  const auto ramp = [&](double top) {  // to a speed
    return top * j >= a * a ? top / a + a / j : 2.0 * std::sqrt(top / j);
  };
  if (v * ramp(v) <= h) return 2.0 * ramp(v) + (h - v * ramp(v)) / v;
  // The top speed is not reached: with constant acceleration, v²/a + v a/j = h, else 2 √(v³/j) = h.
  double top = 0.5 * (-a * a / j + std::sqrt(a * a * a * a / (j * j) + 4.0 * a * h));
  if (top * j < a * a) top = std::cbrt(j * h * h / 4.0);
  return 2.0 * ramp(top);
}

TEST(MotionTiming, OneStraightLegTakesAsLongAsTheDoubleS) {
  const Arm arm = planar_arm();
  const MotionLimits limits{{1.0, 2.0}, {2.0, 3.0}, {10.0, 40.0}};
  // By the first coordinate alone: its speed, its acceleration, neither is reached.
  for (const double way : {3.0, 0.6, 0.05, 1e-4}) {
    const TimedMotion motion = time_motion(arm, view_of(rows_of({{0, 0}, {way, 0}})), limits);
    const double exact = double_s_duration(way, 1.0, 2.0, 10.0);
    EXPECT_NEAR(motion.time.back(), exact, 1e-9 * exact) << way;
  }
  // Both: the first needs 0.5 of its limits for a second, the second all of its jerk.
  const TimedMotion both = time_motion(arm, view_of(rows_of({{0, 0}, {1.0, -2.5}})), limits);
  EXPECT_NEAR(both.time.back(), double_s_duration(2.5, 2.0, 3.0, 25.0), 1e-9);
}

TEST(MotionTiming, LimitsAreKeptAndUsed) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Arm arm = seed % 2 == 0 ? panda() : planar_arm();
    const MotionLimits limits = default_limits(arm);
    RandomStream random(seed);
    TimingOptions options;
    options.step = seed % 3 == 0 ? 0.004 : 0.02;
    options.tolerance = random.uniform(0.0, 0.3);
    const JointMatrix path = random_poses(arm, 2 + static_cast<Index>(seed % 7), seed);
    const TimedMotion motion = time_motion(arm, view_of(path), limits, options);
    const Used share = used(motion, limits);
    EXPECT_LE(share.velocity, 1.0 + 1e-9) << seed;
    EXPECT_LE(share.acceleration, 1.0 + 1e-7) << seed;
    EXPECT_LE(share.jerk, 1.0 + 1e-5) << seed;
    EXPECT_GT(share.jerk, 0.95) << seed;
    EXPECT_TRUE(motion.q.row(0) == path.row(0));
    EXPECT_TRUE(motion.q.bottomRows(1) == path.bottomRows(1));
    EXPECT_LE(motion.time[1], options.step * (1.0 + 1e-12));
    EXPECT_TRUE(std::ranges::is_sorted(motion.along));
  }
}

TEST(MotionTiming, CornersAreRoundedWithinTheToleranceOrStoppedAt) {
  const Arm arm = planar_arm();
  const MotionLimits limits{{1.0, 1.0}, {2.0, 2.0}, {20.0, 20.0}};
  const JointMatrix path = rows_of({{0, 0}, {1, 0}, {1, 1}});
  TimingOptions options;
  options.step = 0.001;
  double before = std::numeric_limits<double>::infinity();
  for (const double tolerance : {0.0, 0.001, 0.01, 0.1}) {
    options.tolerance = tolerance;
    const TimedMotion motion = time_motion(arm, view_of(path), limits, options);
    double nearest = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < motion.q.rows(); ++i) {
      nearest = std::min(nearest, (motion.q.row(i) - path.row(1)).cwiseAbs().maxCoeff());
    }
    EXPECT_LE(nearest, tolerance + 1e-4);
    EXPECT_LE(motion.time.back(), before + 1e-9) << tolerance;
    if (tolerance > 0.005) {
      EXPECT_GE(nearest, 0.4 * tolerance);
    }
    before = motion.time.back();
  }
  EXPECT_LT(before, 0.9 * 2.0 * double_s_duration(1.0, 1.0, 2.0, 20.0));
  options.row_tolerance = {0.0, 0.0, 0.0};
  const double stopping = time_motion(arm, view_of(path), limits, options).time.back();
  EXPECT_NEAR(stopping, 2.0 * double_s_duration(1.0, 1.0, 2.0, 20.0), 1e-9);
}

TEST(MotionTiming, APathAndItsReverseTakeTheSameTime) {
  const Arm arm = panda();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const JointMatrix path = random_poses(arm, 5, seed), back = path.colwise().reverse();
    const TimedMotion one = time_motion(arm, view_of(path)),
                      other = time_motion(arm, view_of(back));
    ASSERT_EQ(one.q.rows(), other.q.rows());
    EXPECT_NEAR(one.time.back(), other.time.back(), 1e-9);
    EXPECT_LT((one.q - other.q.colwise().reverse()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(MotionTiming, RowsOnAStraightLineChangeNothing) {
  const Arm arm = planar_arm();
  JointMatrix dense(101, 2);
  for (Index i = 0; i <= 100; ++i)
    dense.row(i) << 0.02 * static_cast<double>(i), 0.01 * static_cast<double>(i);
  TimingOptions options;
  options.tolerance = 0.0;
  const double exact =
      time_motion(arm, view_of(rows_of({{0, 0}, {2, 1}})), {}, options).time.back();
  const TimedMotion motion = time_motion(arm, view_of(dense), {}, options);
  EXPECT_NEAR(motion.time.back(), exact, 1e-9);
  // Where a row is, in rows of the path given.
  for (Index i = 0; i < motion.q.rows(); ++i) {
    EXPECT_NEAR(motion.along[static_cast<std::size_t>(i)], motion.q(i, 0) / 0.02, 1e-6);
  }
}

TEST(MotionTiming, APathThatTurnsBackReachesItsFarEnd) {
  const Arm arm = planar_arm();
  TimingOptions options;
  options.tolerance = 0.02;
  const TimedMotion motion = time_motion(
      arm, view_of(rows_of({{0, 0}, {0.5, 0}, {1, 0}, {0.2, 0}, {0.6, 0}})), {}, options);
  EXPECT_NEAR(motion.q.col(0).maxCoeff(), 1.0, 0.02);
  EXPECT_EQ(motion.q(motion.q.rows() - 1, 0), 0.6);
  const Used share = used(motion, default_limits(arm));
  EXPECT_LE(share.acceleration, 1.0 + 1e-7);
  EXPECT_LE(share.jerk, 1.0 + 1e-5);
}

TEST(MotionTiming, AMotionThatStaysIsOneRow) {
  const Arm arm = planar_arm();
  const TimedMotion motion = time_motion(arm, view_of(rows_of({{0.3, 0.1}, {0.3, 0.1}})));
  EXPECT_EQ(motion.q.rows(), 1);
  EXPECT_EQ(motion.time, std::vector<double>{0.0});
}

TEST(MotionTiming, DefaultLimits) {
  const Arm arm = irregular_arm(1);
  const MotionLimits limits = default_limits(arm);
  // Joints 0, 4 (by −0.7) and 5 (slides by 0.2) share the first coordinate; the second slides.
  EXPECT_EQ(limits.velocity, (std::vector<double>{1.0, 0.25, 1.0, 1.0}));
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(limits.jerk[k], limits.acceleration[k] / 0.1, 1e-12);
}

std::string refusal(const MotionLimits& limits, const TimingOptions& options = {}) {
  const JointMatrix path = rows_of({{0, 0}, {1, 0}});
  try {
    time_motion(planar_arm(), view_of(path), limits, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MotionTiming, Refusals) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({{1.0, 0.0}, {}, {}}).substr(0, 12), "`velocity[1]");
  EXPECT_EQ(refusal({{}, {-1.0, 1.0}, {}}).substr(0, 16), "`acceleration[0]");
  EXPECT_EQ(refusal({{}, {}, {1.0, kNan}}).substr(0, 8), "`jerk[1]");
  EXPECT_EQ(refusal({{1.0}, {}, {}}).substr(0, 10), "`velocity`");
  EXPECT_EQ(refusal({}, {.step = 0.0}).substr(0, 6), "`step`");
  EXPECT_EQ(refusal({}, {.step = 1e-9}).substr(0, 6), "`step`");
  EXPECT_EQ(refusal({}, {.tolerance = kNan}).substr(0, 11), "`tolerance`");
  EXPECT_EQ(refusal({}, {.row_tolerance = {0.1}}).substr(0, 15), "`row_tolerance`");
  const JointMatrix none(0, 2);
  EXPECT_THROW(time_motion(planar_arm(), view_of(none)), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
