// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/plain_decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <string>

#include "bathyal/base/random.hpp"
#include "bathyal/soundings/internal/digits.hpp"
#include "bathyal/soundings/internal/parse_number.hpp"
#include "bathyal/soundings/internal/round_decimal.hpp"

namespace bathyal {
namespace {

using namespace soundings;

/// Parses `text` with `behind` after it; false where it is not a plain decimal.
bool parse(const std::string& text, double& value, char decimal = '.', char behind = ',') {
  const std::string padded = text + behind + std::string(kTextPadding, '7');
  return parse_plain_decimal(padded.data(), padded.data() + text.size(), decimal, value);
}

void expect_same_bits(const std::string& text) {
  double value = 0.0;
  ASSERT_TRUE(parse(text, value)) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(value),
            std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
      << text;
}

std::string random_digits(RandomStream& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += static_cast<char>('0' + static_cast<int>(random.uniform(0, 10)));
  }
  return text;
}

TEST(PlainDecimal, RoundsEveryShapeAsTheCLibraryDoes) {
  RandomStream random(11);
  for (int whole = 1; whole <= 8; ++whole) {
    for (int fraction = 0; fraction <= 16 && whole + fraction <= 19; ++fraction) {
      for (int i = 0; i < 1000; ++i) {
        std::string text(i % 2 == 0 ? "" : "-");
        text.append(random_digits(random, whole));
        if (fraction > 0) text.append(".").append(random_digits(random, fraction));
        expect_same_bits(text);
      }
    }
  }
}

TEST(PlainDecimal, KeepsZerosAndTheirSigns) {
  for (const char* text :
       {"0", "-0", "0.0", "-0.000", "00000000", "00000001.5", "0.00000001", "-0.0000000000000001",
        "00000000.00000001", "99999999.99999999", "99999999.99999999999", "0.9999999999999999"}) {
    expect_same_bits(text);
  }
}

TEST(PlainDecimal, LeavesEverythingElseToTheGeneralParser) {
  double value = 0.0;
  for (const char* text : {"",
                           "-",
                           "+1",
                           ".5",
                           "5.",
                           "-.5",
                           "1e5",
                           "1.5e5",
                           "1.5e-300",
                           "4.9e-324",
                           "nan",
                           "inf",
                           "123456789",
                           "123456789.5",
                           "0.12345678901234567",
                           "12345678.123456789012",
                           "1.2.3",
                           "1,5",
                           "1 ",
                           " 1",
                           "--1",
                           "1-2",
                           "0x10",
                           "12a4",
                           "1.2345678a",
                           "1.23456789a",
                           "1.234567a9",
                           "1.:",
                           "1./",
                           "\xb1",
                           "1.\xb9",
                           "0.00000000000"}) {
    EXPECT_FALSE(parse(text, value)) << text;
  }
}

TEST(PlainDecimal, TakesTheDecimalMarkItIsGiven) {
  double value = 0.0;
  EXPECT_TRUE(parse("-1,25", value, ',', ';'));
  EXPECT_EQ(value, -1.25);
  EXPECT_FALSE(parse("-1.25", value, ',', ';'));
}

TEST(PlainDecimal, AgreesWithTheGeneralParserOnAnyBytes) {
  RandomStream random(12);
  const std::string alphabet = "0123456789012345678901234567890123456789..-+e ";
  int taken = 0;
  for (int i = 0; i < 300000; ++i) {
    std::string text;
    const int length = static_cast<int>(random.uniform(0, 22));
    for (int k = 0; k < length; ++k) {
      text += alphabet[static_cast<std::size_t>(random.uniform(0, 1) * 46)];
    }
    double plain = 0.0;
    if (!parse(text, plain)) continue;
    ++taken;
    double general = 0.0;
    const std::string padded = text + "," + std::string(kTextPadding, '\0');
    ASSERT_EQ(parse_number(padded.data(), '.', general), padded.data() + text.size()) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(plain), std::bit_cast<std::uint64_t>(general)) << text;
  }
  EXPECT_GT(taken, 10000);
}

/// Digits whose quotient by 10^power is a tie between two doubles, or as near one as can be.
TEST(RoundDecimal, DividesAsExactlyByMultiplication) {
  RandomStream random(13);
  for (int power = 1; power <= number::kMostFives; ++power) {
    for (int i = 0; i < 20000; ++i) {
      const std::uint64_t digits = random.next() >> static_cast<int>(random.uniform(0, 63));
      for (const std::uint64_t near : {digits - 1, digits, digits + 1}) {
        if (near == 0) continue;
        ASSERT_EQ(number::divide(near, power), number::divide_exactly(near, power))
            << near << " / 10^" << power;
      }
    }
  }
}

TEST(RoundDecimal, RoundsTiesToEven) {
  // 2^53 + 2 k + 1 lies half way between two doubles.
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const std::uint64_t tie = (std::uint64_t{1} << 53U) + 2 * k + 1;
    for (int power = 1; power <= 2; ++power) {
      const std::uint64_t scale = power == 1 ? 10 : 100;
      std::string text = std::to_string(tie * scale);
      text.append("e-").append(std::to_string(power));
      const double expected = std::strtod(text.c_str(), nullptr);
      EXPECT_EQ(number::divide(tie * scale, power), expected);
      EXPECT_EQ(number::divide_exactly(tie * scale, power), expected);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(expected) & 1U, 0U);
    }
  }
}

TEST(Digits, AreCountedAlignedAndJoined) {
  RandomStream random(17);
  for (int count = 1; count <= 8; ++count) {
    const std::string digits = random_digits(random, count);
    const std::string text =
        digits + "x9999999";  // whatever follows the first other byte is ignored
    const std::uint64_t values = number::load_digits(text.data());
    ASSERT_EQ(number::count_digits(values), count);
    EXPECT_EQ(number::join_digits(number::align_digits(values, count)), std::stoull(digits));
  }
  const std::string sixteen = random_digits(random, 16);
  const auto [first, second] = number::join_digits(number::load_digits(sixteen.data()),
                                                   number::load_digits(sixteen.data() + 8));
  EXPECT_EQ(first, std::stoull(sixteen.substr(0, 8)));
  EXPECT_EQ(second, std::stoull(sixteen.substr(8)));
}

}  // namespace
}  // namespace bathyal
