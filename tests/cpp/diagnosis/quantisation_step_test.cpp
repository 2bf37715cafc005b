// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/quantisation_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/base/random.hpp"
#include "diagnosis/small_arms.hpp"

namespace bathyal::diagnosis {
namespace {

RowMatrix joints(double step) {
  RowMatrix q(60, 2);
  for (Index i = 0; i < q.rows(); ++i) {
    RandomStream random(4, static_cast<std::uint64_t>(i));
    for (Index j = 0; j < 2; ++j) {
      const double value = random.uniform(-3.0, 3.0);
      q(i, j) = step > 0.0 ? step * std::round(value / step) : value;
    }
  }
  return q;
}

TEST(QuantisationStep, IsFound) {
  for (const double step : {2e-5, 1.7e-4, 3.1415926535897931 / 8192.0, 0.02}) {
    EXPECT_NEAR(quantisation_step(joints(step), two_joints()) / step, 1.0, 1e-9) << step;
  }
}

TEST(QuantisationStep, IsZeroWithoutOne) {
  EXPECT_EQ(quantisation_step(joints(0.0), two_joints()), 0.0);
}

TEST(QuantisationStep, IsZeroWithOneValueOffTheGrid) {
  RowMatrix q = joints(1e-3);
  q(7, 1) += 4.3e-4;
  EXPECT_NE(quantisation_step(q, two_joints()), 1e-3);
}

}  // namespace
}  // namespace bathyal::diagnosis
