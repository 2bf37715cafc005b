// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/fit_summary.hpp"

#include <gtest/gtest.h>

#include "bathyal/base/text.hpp"
#include "support/arms.hpp"

namespace bathyal {
namespace {

ArmFit good_fit() {
  ArmFit fit(planar_arm());
  fit.parameters.push_back(
      {"theta_1", "theta of row 1", "rad", "row 1", 0, 0, 0, Status::kGauge, {}});
  fit.parameters.push_back(
      {"a_1", "a of row 1", "m", "row 1", 0.5, 0.502, 2e-4, Status::kIdentified, {}});
  fit.parameters.push_back(
      {"a_2", "a of row 2", "m", "row 2", 0.4, 0.401, 5e-4, Status::kIdentified, {}});
  fit.parameters.push_back(
      {"theta_2", "theta of row 2", "rad", "row 2", 0, 0.001, 1e-3, Status::kIdentified, {}});
  fit.rms_before = 8.422e-3;
  fit.rms_after = 3.01e-4;
  fit.noise = 1.7e-4;
  fit.residuals.setZero(3, 63);
  fit.point_labels = {0, 1, 2};
  fit.scale = 1.001;
  fit.scale_std = 5e-4;
  fit.scale_source = "known distance";
  return fit;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Summary, TellsWhatWasFoundAndHowSurely) {
  const std::string text = summarize(good_fit());
  EXPECT_TRUE(says(text, "63 poses at 3 points"));
  EXPECT_TRUE(says(text, "from 8.42 mm to 0.301 mm rms"));
  EXPECT_TRUE(says(text, "Of 4 parameters: 3 determined by the data and 1 redundant"));
  EXPECT_TRUE(says(text, "a of row 2 ± 0.5 mm and theta of row 2 ± 0.0573 deg (1 sigma)"));
  EXPECT_TRUE(says(text, "is determined by: known distance"));
  EXPECT_TRUE(says(text, "No check raised a warning"));
}

TEST(Summary, IsNotConfidentWhereWarningsStand) {
  ArmFit fit = good_fit();
  fit.warnings = {"First warning.", "Second warning."};
  const std::string text = summarize(fit);
  EXPECT_FALSE(says(text, "No check raised"));
  EXPECT_TRUE(says(text, "2 warnings. (1) First warning. (2) Second warning."));
  fit.warnings.pop_back();
  EXPECT_TRUE(says(summarize(fit), "Warning: First warning."));
}

TEST(Wording, NumbersAndLists) {
  EXPECT_EQ(millimetres(0.0123456), "12.3 mm");
  EXPECT_EQ(degrees(kPi / 4), "45 deg");
  EXPECT_EQ(in_its_unit(0.001, "m"), "1 mm");
  EXPECT_EQ(counted(1, "pose"), "1 pose");
  EXPECT_EQ(counted(2, "touch", "touches"), "2 touches");
  EXPECT_EQ(listed(std::vector<int>{}), "");
  EXPECT_EQ(listed(std::vector<int>{4}), "4");
  EXPECT_EQ(listed(std::vector<int>{4, 5, 6}), "4, 5 and 6");
  EXPECT_EQ(listed(std::vector<int>{4, 5, 6}, 2), "4, 5 and 1 more");
}

}  // namespace
}  // namespace bathyal
