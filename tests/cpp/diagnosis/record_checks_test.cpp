// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/internal/record_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "diagnosis/small_arms.hpp"

namespace bathyal::diagnosis {
namespace {

std::vector<std::string> checked(const Covariates& covariates) {
  const Arm arm = two_joints();
  const RowMatrix q = RowMatrix::Random(6, 2);
  return check_record(make_effect_data(arm, q, covariates, false), library_effects());
}

RowMatrix column(std::initializer_list<double> values) {
  RowMatrix out(static_cast<Index>(values.size()), 1);
  std::copy(values.begin(), values.end(), out.data());
  return out;
}

TEST(RecordChecks, ACompleteRecordHasNoWarnings) {
  EXPECT_TRUE(checked({}).empty());
  EXPECT_TRUE(checked({{"time", column({0, 1, 2, 3, 4, 5})}}).empty());
}

TEST(RecordChecks, WarnOfMissingAndConstantCovariates) {
  const auto missing = checked({{"time", column({0, 1, std::nan(""), 3, 4, 5})}});
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_EQ(missing[0].rfind("`time` is missing in 1 of 6 rows", 0), 0U) << missing[0];
  const auto constant = checked({{"temperature", column({5, 5, 5, 5, 5, 5})}});
  ASSERT_EQ(constant.size(), 1U);
  EXPECT_EQ(constant[0].rfind("`temperature` is the same in all rows", 0), 0U) << constant[0];
}

TEST(RecordChecks, WarnOfTimesThatRunBackwardsAndOfShortSessions) {
  const auto back = checked({{"time", column({0, 1, 5, 3, 4, 6})}});
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].rfind("`time` runs backwards once, at row 3", 0), 0U) << back[0];
  const auto few = checked({{"session", column({0, 0, 0, 0, 1, 1})}});
  ASSERT_EQ(few.size(), 1U);
  EXPECT_EQ(few[0].rfind("1 of 2 sessions has fewer than three rows", 0), 0U) << few[0];
}

TEST(WholeOrder, IsOfWavesAlone) {
  EffectVariant variant;
  EXPECT_FALSE(has_whole_order(variant));
  variant.settings["order"] = 2.0;
  EXPECT_TRUE(has_whole_order(variant));
  variant.settings["order"] = 2.5;
  EXPECT_FALSE(has_whole_order(variant));
}

}  // namespace
}  // namespace bathyal::diagnosis
