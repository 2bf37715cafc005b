// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/ardusub.hpp"
#include "bathyal/protocol/pd6.hpp"

namespace bathyal {
namespace {

TEST(ArduSub, APacketIsReadAsPublished) {
  // magic 18458 = 0x481A, 400 Hz, frame 258, then pulses, all little-endian
  std::string bytes("\x1a\x48\x90\x01\x02\x01\x00\x00", 8);
  for (int i = 0; i < 16; ++i) bytes.append("\xdc\x05", 2);  // 1 500
  const ServoPacket packet = read_servo_packet(bytes);
  EXPECT_EQ(packet.rate, 400);
  EXPECT_EQ(packet.frame, 258U);
  ASSERT_EQ(packet.pulses.size(), 16U);
  EXPECT_EQ(packet.pulses[15], 1500);
  EXPECT_EQ(servo_packet(packet), bytes);
  ServoPacket wide = packet;
  wide.pulses.assign(32, 1900);
  EXPECT_EQ(servo_packet(wide).substr(0, 2), "\x81\x73");  // 29 569 = 0x7381
  EXPECT_EQ(read_servo_packet(servo_packet(wide)).pulses.size(), 32U);
}

TEST(ArduSub, OtherPacketsAreRefused) {
  ServoPacket packet;
  packet.pulses.assign(16, 1500);
  const std::string bytes = servo_packet(packet);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(read_servo_packet(bytes.substr(0, size)), Error);
  }
  EXPECT_THROW(read_servo_packet(bytes + "x"), Error);
  EXPECT_THROW(read_servo_packet(std::string(40, 'x')), Error);
  packet.pulses.assign(8, 1500);
  EXPECT_THROW(servo_packet(packet), std::invalid_argument);
}

TEST(ArduSub, PulsesAreCommands) {
  EXPECT_EQ(command_of_pulse(1500), 0.0);
  EXPECT_EQ(command_of_pulse(1900), 1.0);
  EXPECT_EQ(command_of_pulse(1100), -1.0);
  EXPECT_EQ(command_of_pulse(1600), 0.25);
  EXPECT_EQ(command_of_pulse(2200), 1.0);
  EXPECT_EQ(command_of_pulse(0), 0.0);
}

TEST(ArduSub, TheStateIsALineOfJson) {
  ArduPilotState state;
  state.time = 0.0025;
  state.force = Vec3(0, 0, -9.8);
  EXPECT_EQ(ardupilot_json(state),
            "\n{\"timestamp\":0.0025,\"imu\":{\"gyro\":[0,0,0],\"accel_body\":[0,0,-9.8]},"
            "\"position\":[0,0,0],\"attitude\":[0,0,0],\"velocity\":[0,0,0]}\n");
  state.altitude = 2.5;
  EXPECT_NE(ardupilot_json(state).find(",\"rng_1\":2.5}"), std::string::npos);
  state.velocity.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ardupilot_json(state), std::invalid_argument);
}

Pd6Ensemble ensemble() {
  Pd6Ensemble e;
  e.heading = 123.456;
  e.pitch = -1.5;
  e.roll = 0.25;
  e.time = 3661.25;
  e.day = 7, e.month = 6, e.year = 2026;
  e.depth = 12.34;
  e.velocity = Vec3(1.2345, 0.25, -0.1);
  e.altitude = 3.219;
  e.age = 0.2;
  return e;
}

TEST(Pd6, LinesAreAsTheManualHasThem) {
  EXPECT_EQ(pd6_text(ensemble()),
            ":SA,-01.50,+00.25,123.46\r\n"
            ":TS,26060701010125,35.0,+10.0,0012.3,1500.0,0\r\n"
            ":BS,-00250,+01234,-00100,A\r\n"
            ":BD,+00000000.00,+00000000.00,+00000000.00,0003.22,000.20\r\n");
}

TEST(Pd6, ComesBackWithinItsDigits) {
  Pd6Ensemble found;
  std::string text = pd6_text(ensemble());
  int known = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    known += read_pd6_line(text.substr(at, end - at), found) ? 1 : 0;
    at = end;
  }
  EXPECT_EQ(known, 4);
  EXPECT_LT((found.velocity - ensemble().velocity).cwiseAbs().maxCoeff(), 0.51e-3);
  EXPECT_NEAR(found.heading, 123.456, 0.005);
  EXPECT_NEAR(found.altitude.value(), 3.219, 0.005);
  EXPECT_NEAR(found.time, 3661.25, 1e-9);
  EXPECT_EQ(found.month, 6);
  EXPECT_TRUE(found.valid);
}

TEST(Pd6, AVelocityThatIsNoneLeavesTheLastOne) {
  Pd6Ensemble found = ensemble(), lost = ensemble();
  lost.valid = false;
  lost.altitude.reset();
  const std::string text = pd6_text(lost);
  EXPECT_NE(text.find(":BS,-32768,-32768,-32768,V"), std::string::npos);
  read_pd6_line(":BS,-32768,-32768,-32768,V", found);
  EXPECT_FALSE(found.valid);
  EXPECT_EQ(found.velocity, ensemble().velocity);
}

TEST(Pd6, OtherLinesAreSkippedAndBrokenOnesRefused) {
  Pd6Ensemble found;
  EXPECT_FALSE(read_pd6_line("", found));
  EXPECT_FALSE(read_pd6_line(":WI,1,2,3,4,A", found));
  for (const char* line :
       {":SA,1,2", ":SA,1,2,x", ":TS,2606,1,2,3,4,5", ":BS,1,2,3",
        ":TS,26x60701010125,35.0,+10.0,0012.3,1500.0,0", ":BD,1,2,3,nan,1", ":SA,1e99,2,3"}) {
    EXPECT_THROW(read_pd6_line(line, found), Error) << line;
  }
  Pd6Ensemble fast = ensemble();
  fast.velocity.x() = 100.0;
  EXPECT_THROW(pd6_text(fast), std::invalid_argument);
}

}  // namespace
}  // namespace bathyal
