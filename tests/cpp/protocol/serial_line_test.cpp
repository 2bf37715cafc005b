// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/serial_line.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <string>

namespace bathyal {
namespace {

std::string line_of(std::size_t size) { return std::string(size - 1, 'a') + "\n"; }

TEST(SerialLine, CarriesFourHundredAndEightyBytesASecond) {
  SerialLineOptions options;
  SerialLineState state;
  std::size_t arrived = 0;
  for (int i = 0; i < 600; ++i) {
    arrived += carry(options, state, line_of(60), 0.1, 1).size();  // 600 bytes a second
  }
  EXPECT_EQ(arrived, state.carried);
  EXPECT_NEAR(static_cast<double>(arrived) / 60.0, 480.0, 1.0);
  // what did not fit was lost, and said so
  EXPECT_EQ(state.carried + state.lost + state.waiting.size(), 600U * 60U);
  EXPECT_GT(state.lost, 3000U);
  EXPECT_LE(state.waiting.size(), options.buffer);
}

TEST(SerialLine, ALineArrivesWhenItsLastByteDoes) {
  SerialLineOptions options;
  SerialLineState state;
  EXPECT_TRUE(carry(options, state, line_of(96), 0.1, 1).empty());
  EXPECT_EQ(carry(options, state, "", 0.1, 1).size(), 96U);
}

TEST(SerialLine, AnIdleLineSavesNothingUp) {
  SerialLineOptions options;
  SerialLineState state;
  for (int i = 0; i < 100; ++i) carry(options, state, "", 1.0, 1);
  EXPECT_TRUE(carry(options, state, line_of(96), 0.1, 1).empty());
}

TEST(SerialLine, BytesWithoutAnEndDoNotBlockIt) {
  SerialLineOptions options;
  options.buffer = 100;
  SerialLineState state;
  std::size_t arrived = 0;
  for (int i = 0; i < 10; ++i)
    arrived += carry(options, state, std::string(60, 'a'), 0.1, 1).size();
  EXPECT_GE(arrived, 300U);
}

TEST(SerialLine, BitErrorsAreCountedAndKeyed) {
  SerialLineOptions options;
  options.bit_error_rate = 1e-3;
  options.baud = 1e6;
  SerialLineState whole, parts;
  const std::string text = line_of(50'000);
  options.buffer = 200'000;
  std::string arrived;
  for (int i = 0; i < 2; ++i) arrived += carry(options, whole, text, 1.0, 7);
  std::uint64_t turned = 0;
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    const char sent = text[i % text.size()];
    turned +=
        static_cast<std::uint64_t>(std::popcount(static_cast<unsigned char>(sent ^ arrived[i])));
  }
  EXPECT_EQ(turned, whole.turned);
  EXPECT_NEAR(static_cast<double>(turned), 800.0, 120.0);  // of 800 000 bits
  // the same bytes turn however they are handed over
  carry(options, parts, text + text, 0.0, 7);
  EXPECT_EQ(carry(options, parts, "", 2.0, 7), arrived);
}

TEST(SerialLine, OptionsAreChecked) {
  SerialLineOptions options;
  options.baud = 0.0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.buffer = 0;
  EXPECT_THROW(options.check(), std::invalid_argument);
  options = {};
  options.bit_error_rate = 1.5;
  EXPECT_THROW(options.check(), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
