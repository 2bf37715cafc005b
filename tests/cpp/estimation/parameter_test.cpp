// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/estimation/parameter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bathyal {
namespace {

TEST(Parameter, IsFoundByItsName) {
  const std::vector<Parameter> parameters{{"theta_1", "theta of row 1", "rad", "row 1"},
                                          {"d_1", "d of row 1", "m", "row 1"}};
  EXPECT_EQ(find_parameter(parameters, "d_1"), 1);
  EXPECT_EQ(find_parameter(parameters, "d_2"), -1);
  EXPECT_EQ(find_parameter({}, "d_1"), -1);
  EXPECT_TRUE(std::isinf(parameters[0].prior_std)) << "no prior unless given";
}

}  // namespace
}  // namespace bathyal
