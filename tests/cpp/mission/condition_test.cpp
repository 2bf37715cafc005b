// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/condition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace bathyal {
namespace {

const std::vector<std::string> kNames{"depth", "battery", "leak", "fault.thruster_1", "heading"};

bool holds(const std::string& text, const std::vector<double>& values) {
  return Condition(text, kNames).holds(values);
}

TEST(Condition, ComparesSignalsWithNumbersAndUnits) {
  const std::vector<double> values{41.0, 0.19, 0.0, 1.0, 1.0};
  EXPECT_TRUE(holds("depth > 40 m", values));
  EXPECT_FALSE(holds("depth > 0.05 km", values));
  EXPECT_TRUE(holds("battery < 20 %", values));
  EXPECT_TRUE(holds("heading > 57 deg and heading < 58 deg", values));
  EXPECT_TRUE(holds("battery <= depth", values));
  EXPECT_TRUE(holds("depth == 41 and depth != 40", values));
}

TEST(Condition, ASignalIsComparedWithItsOwnQuantity) {
  const std::vector<std::string> units{"m", "1", "kg", "1", "rad"};
  for (const char* text : {"depth > 40 m", "depth > 40 cm", "depth > 40", "40 km > depth",
                           "battery < 20 %", "leak > 1 kg", "fault.thruster_1 == battery"}) {
    EXPECT_NO_THROW(Condition(text, kNames, units)) << text;
  }
  for (const char* text : {"depth > 40 s", "depth > 40 deg", "40 s < depth", "battery < 20 V",
                           "depth > battery", "heading > 1 m and leak", "40 m > 40 s"}) {
    EXPECT_THROW(Condition(text, kNames, units), std::invalid_argument) << text;
  }
  try {
    const Condition condition("leak or depth > 3 s", kNames, units);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "`condition`: expected a quantity in m, got '3 s' at column 17 of 'leak or depth > "
        "3 s'");
  }
}

TEST(Condition, AndBindsMoreTightlyThanOr) {
  const std::vector<double> values{1.0, 0.0, 0.0, 1.0, 0.0};
  EXPECT_TRUE(holds("depth == 1 or leak == 1 and battery == 1", values));
  EXPECT_FALSE(holds("(depth == 1 or leak == 1) and battery == 1", values));
  EXPECT_TRUE(holds("not leak and fault.thruster_1", values));
  EXPECT_TRUE(holds("not not depth", values));
}

TEST(Condition, AValueThatIsNotKnownMakesAComparisonFalse) {
  const std::vector<double> values(5, std::numeric_limits<double>::quiet_NaN());
  for (const char* text : {"depth < 1", "depth > 1", "depth == 1", "depth != 1", "leak"}) {
    EXPECT_FALSE(holds(text, values)) << text;
  }
}

TEST(Condition, MistakesAreReportedByColumn) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "column 1"},
      {"deep > 3", "column 1"},
      {"depth >", "column 8"},
      {"depth > 3 or", "column 13"},
      {"(depth > 3", "column 11"},
      {"depth > 3)", "column 10"},
      {"depth > 3 lb", "column 11"},
      {"depth > nan", "column 9"},
      {"depth > inf", "column 9"},
      {"3", "column 2"},
      {"depth > 1e999", "column 9"},
      {"__import__('os')", "column 1"},
      {std::string(200, '('), "column"},
      {std::string(1001, 'x'), "1000 characters"}};
  for (const auto& [text, part] : cases) {
    try {
      const Condition condition(text, kNames);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

TEST(Condition, DeepBracketsFitTheStack) {
  std::string text;
  for (int i = 0; i < 49; ++i) text += "leak or depth and (";
  text += "depth > 0";
  text += std::string(49, ')');
  EXPECT_TRUE(holds(text, {1.0, 0.0, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace bathyal
