// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/parse_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

using namespace soundings;

struct Parsed {
  bool is_number;
  std::size_t length;
  double value;
};

Parsed parse(const std::string& text, char decimal = '.') {
  std::string padded = text + std::string(kTextPadding, '\0');
  double value = 0.0;
  const char* const end = parse_number(padded.data(), decimal, value);
  if (end == nullptr) return {false, 0, 0.0};
  return {true, static_cast<std::size_t>(end - padded.data()), value};
}

void expect_same_bits(const std::string& text) {
  const Parsed parsed = parse(text);
  ASSERT_TRUE(parsed.is_number) << text;
  EXPECT_EQ(parsed.length, text.size()) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(parsed.value),
            std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
      << text;
}

TEST(ParseNumber, RoundsAsTheCLibraryDoesWhereRoundingIsHard) {
  for (const char* text : {"0",
                           "-0",
                           "+7",
                           "5.",
                           ".5",
                           "-.5e-3",
                           "9007199254740993",
                           "9007199254740992.5",
                           "9007199254740991.500",
                           "4503599627370497.5",
                           "4503599627370496.5",
                           "1e22",
                           "1e23",
                           "123456789012345678",
                           "18446744073709551615",
                           "18446744073709551616",
                           "0.1234567890123456789",
                           "1234567.1234567890123",
                           "9.007199254740993",
                           "90071.99254740993",
                           "1.7976931348623157e308",
                           "1.7976931348623159e308",
                           "2.2250738585072014e-308",
                           "4.9e-324",
                           "2.4e-324",
                           "2.5e-324",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "0e400",
                           "0.0e-400",
                           "0.00000000000000000000000000000000000000000000001e50",
                           "1e999999999999",
                           "1e-999999999999",
                           "100000000000000000000000000000000000000000",
                           "620152.873",
                           "7246504.912",
                           "-52.9013"}) {
    expect_same_bits(text);
  }
}

TEST(ParseNumber, RoundsRandomDigitsOfAnyLengthAsTheCLibraryDoes) {
  RandomStream random(7);
  for (int i = 0; i < 200000; ++i) {
    const auto digits = static_cast<int>(random.uniform(1, 23));
    const auto point = static_cast<int>(random.uniform(0, digits + 1));
    std::string text = random.uniform() < 0.5 ? "-" : "";
    for (int k = 0; k < digits; ++k) {
      if (k == point) text += '.';
      text += static_cast<char>('0' + static_cast<int>(random.uniform(0, 10)));
    }
    if (random.uniform() < 0.3) {
      text.append("e").append(std::to_string(static_cast<int>(random.uniform(-340, 320))));
    }
    expect_same_bits(text);
  }
}

TEST(ParseNumber, ReadsBackTheShortestTextOfAnyDouble) {
  RandomStream random(8);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) expect_same_bits(to_text(value));
  }
}

TEST(ParseNumber, SaysWhereTheNumberEnds) {
  EXPECT_EQ(parse("12.5,3").length, 4U);
  EXPECT_EQ(parse("12.5.3").length, 4U);
  EXPECT_EQ(parse("1-2").length, 1U);
  EXPECT_EQ(parse("1,5;", ',').value, 1.5);
  EXPECT_EQ(parse("1,5;", ',').length, 3U);
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "-", "+", ".", "-.", "e5", "1e", "1e+", "x", " 1", "--1", "nan", "\xff"}) {
    EXPECT_FALSE(parse(text).is_number) << text;
  }
  EXPECT_FALSE(parse("12, 13", ',').is_number);  // a comma that separates
}

}  // namespace
}  // namespace bathyal
