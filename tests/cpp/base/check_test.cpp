// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace bathyal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Check>
std::string refusal(const Check& check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Check, NamesTheArgumentWhatIsExpectedAndWhatWasGiven) {
  EXPECT_EQ(refusal([] { check_positive("step", -0.5); }),
            "`step`: expected a finite number above 0, got -0.5");
  EXPECT_EQ(refusal([] { check_range("share", 2.0, 0.0, 1.0); }),
            "`share`: expected a number from 0 to 1, got 2");
}

TEST(Check, BordersAndNan) {
  EXPECT_EQ(refusal([] { check_range("x", 0.0, 0.0, 1.0); }), "");
  EXPECT_EQ(refusal([] { check_range("x", 1.0, 0.0, 1.0); }), "");
  EXPECT_EQ(refusal([] { check_not_negative("x", 0.0); }), "");
  EXPECT_NE(refusal([] { check_positive("x", 0.0); }), "");
  for (const double bad : {std::nan(""), kInfinity}) {
    EXPECT_NE(refusal([&] { check_finite("x", bad); }), "");
    EXPECT_NE(refusal([&] { check_positive("x", bad); }), "");
    EXPECT_NE(refusal([&] { check_not_negative("x", bad); }), "");
    EXPECT_NE(refusal([&] { check_range("x", bad, 0.0, 1.0); }), "");
  }
}

}  // namespace
}  // namespace bathyal
