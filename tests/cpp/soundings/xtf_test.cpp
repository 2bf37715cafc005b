// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/formats/xtf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/soundings/formats/sidescan.hpp"

namespace bathyal {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Amplitude 100 beam + sample + ping.
SidescanPings example(std::size_t count, std::int64_t samples) {
  SidescanPings pings;
  pings.beam_names = {"port", "starboard"};
  pings.samples = samples;
  pings.frequency = 600e3;
  pings.amplitude_step = 1.0;
  pings.sonar_name = "test";
  for (std::size_t k = 0; k < count; ++k) {
    for (int beam = 0; beam < 2; ++beam) {
      for (std::int64_t i = 0; i < samples; ++i) {
        pings.amplitude.push_back(static_cast<float>(100 * beam + i + static_cast<int>(k)));
      }
      pings.slant_range.push_back(30.0);
    }
    const auto number = static_cast<double>(k);
    pings.time.push_back(1378847588.25 + number);
    pings.x.push_back(-1.2 + 1e-7 * number);
    pings.y.push_back(0.8455);
    pings.depth.push_back(14.5);
    pings.altitude.push_back(4.0 + 0.25 * number);
    pings.heading.push_back(0.5);
    pings.pitch.push_back(-0.125);
    pings.roll.push_back(0.0625);
    pings.speed.push_back(1.5);
    pings.sound_speed.push_back(1500.0);
    pings.number.push_back(static_cast<std::int64_t>(k));
  }
  pings.geographic = true;
  return pings;
}

std::vector<std::uint8_t> bytes_of(const SidescanPings& pings) { return format_xtf(xtf_of(pings)); }

TEST(Xtf, WhatIsWrittenIsRead) {
  const SidescanPings given = example(300, 50);
  const XtfFile file = parse_xtf(bytes_of(given));
  EXPECT_EQ(file.ping_count(), 300);  // more than a byte counts
  EXPECT_EQ(file.damaged + file.lost_bytes, 0);
  const SidescanPings read = sidescan_of(file);
  EXPECT_EQ(read.beam_names, given.beam_names);
  EXPECT_EQ(read.amplitude, given.amplitude);
  EXPECT_EQ(read.slant_range, given.slant_range);
  EXPECT_TRUE(read.geographic);
  for (std::size_t k = 0; k < given.count(); ++k) {
    EXPECT_NEAR(read.time[k], given.time[k], 0.005);
    EXPECT_NEAR(read.x[k], given.x[k], 1e-15);
    EXPECT_NEAR(read.y[k], given.y[k], 1e-15);
    EXPECT_NEAR(read.altitude[k], given.altitude[k], 1e-6);
    EXPECT_NEAR(read.heading[k], given.heading[k], 1e-7);
    EXPECT_NEAR(read.pitch[k], given.pitch[k], 1e-7);
    EXPECT_NEAR(read.roll[k], given.roll[k], 1e-7);
    EXPECT_NEAR(read.speed[k], given.speed[k], 1e-6);
    EXPECT_EQ(read.number[k], given.number[k]);
  }
}

TEST(Xtf, ReadAndWrittenAgainIsTheSameBytes) {
  const std::vector<std::uint8_t> bytes = bytes_of(example(4, 33));
  EXPECT_EQ(format_xtf(parse_xtf(bytes)), bytes);
  EXPECT_EQ(bytes.size() % 64, 0U);
}

TEST(Xtf, PortIsStoredFarToNear) {
  const XtfFile file = xtf_of(example(1, 10));
  const XtfPacket& ping = file.packets.front();
  EXPECT_EQ(xtf_samples(file, ping.channels[0]).front(), 9.0);
  EXPECT_EQ(xtf_samples(file, ping.channels[1]).front(), 100.0);
  EXPECT_EQ(file.channel_type(0), 1);
  EXPECT_EQ(file.channel_name(1), "STARBOARD");
}

TEST(Xtf, OneWithoutNavigationHasNone) {
  SidescanPings pings = example(2, 5);
  pings.x[1] = pings.y[1] = pings.altitude[1] = kNan;
  const SidescanPings read = sidescan_of(parse_xtf(bytes_of(pings)));
  EXPECT_FALSE(std::isnan(read.altitude[0]));
  EXPECT_TRUE(std::isnan(read.x[1]));
  EXPECT_TRUE(std::isnan(read.altitude[1]));
}

TEST(Xtf, AFileCutAnywhereGivesItsWholePings) {
  const std::vector<std::uint8_t> bytes = bytes_of(example(3, 7));
  const std::size_t ping = (bytes.size() - 1024) / 3;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const std::span<const std::uint8_t> cut(bytes.data(), size);
    if (size < 1024) {
      EXPECT_THROW(parse_xtf(cut), Error) << size;
      continue;
    }
    const XtfFile file = parse_xtf(cut);
    const std::size_t whole = (size - 1024) / ping;
    EXPECT_EQ(file.ping_count(), static_cast<std::int64_t>(whole)) << size;
    EXPECT_EQ(file.lost_bytes, static_cast<std::int64_t>(size - 1024 - whole * ping)) << size;
  }
}

TEST(Xtf, APacketWithWrongSizesIsLeftOutAndTheNextOneRead) {
  const std::vector<std::uint8_t> good = bytes_of(example(3, 7));
  const std::size_t ping = (good.size() - 1024) / 3;
  const std::size_t second = 1024 + ping;
  const auto with = [&](std::size_t offset, std::uint32_t value) {
    std::vector<std::uint8_t> bytes = good;
    std::memcpy(bytes.data() + second + offset, &value, sizeof value);
    return parse_xtf(bytes);
  };
  for (const std::uint32_t samples : {8U, 1000000000U, 0xFFFFFFFFU}) {
    EXPECT_EQ(with(256 + 42, samples).ping_count(), 2) << samples;
  }
  for (const std::uint32_t size : {0U, 13U, 1000000000U, 0xFFFFFFFFU}) {
    const XtfFile file = with(10, size);
    EXPECT_EQ(file.ping_count(), 2) << size;
    EXPECT_EQ(file.damaged, 1);
    EXPECT_EQ(file.lost_bytes, static_cast<std::int64_t>(ping));
  }
  const XtfFile channels = with(4, 0xFFFFU);  // how many channels follow
  EXPECT_EQ(channels.ping_count(), 2);
  EXPECT_EQ(channels.damaged, 1);
}

TEST(Xtf, UnknownPacketsAreCountedAndKept) {
  std::vector<std::uint8_t> bytes = bytes_of(example(2, 7));
  std::vector<std::uint8_t> other(64);
  const std::uint16_t mark = 0xFACE;
  const std::uint32_t size = 64;
  std::memcpy(other.data(), &mark, 2);
  other[2] = 199;
  std::memcpy(other.data() + 10, &size, 4);
  bytes.insert(bytes.begin() + 1024, other.begin(), other.end());
  const XtfFile file = parse_xtf(bytes);
  EXPECT_EQ(file.ping_count(), 2);
  EXPECT_EQ(file.other_packets.at(199), 1);
  EXPECT_EQ(format_xtf(file), bytes);
}

TEST(Xtf, RandomDamageNeverBreaksTheReader) {
  const std::vector<std::uint8_t> good = bytes_of(example(4, 20));
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomStream random(seed);
    std::vector<std::uint8_t> bytes = good;
    for (int i = 0; i < 8; ++i) {
      bytes[random.next() % bytes.size()] = static_cast<std::uint8_t>(random.next());
    }
    bytes[0] = 123;
    try {
      const XtfFile file = parse_xtf(bytes);
      EXPECT_LE(file.ping_count(), 4);
      const SidescanPings pings = sidescan_of(file);
      EXPECT_EQ(pings.amplitude.size(), pings.count() * static_cast<std::size_t>(pings.rows()) *
                                            static_cast<std::size_t>(pings.samples));
    } catch (const Error&) {
    }
  }
}

TEST(Xtf, RefusesWhatItCannotWrite) {
  SidescanPings negative = example(1, 4);
  negative.amplitude[2] = -1.0F;
  EXPECT_THROW(xtf_of(negative), std::invalid_argument);
  SidescanPings short_of = example(2, 4);
  short_of.amplitude.pop_back();
  EXPECT_THROW(xtf_of(short_of), std::invalid_argument);
  EXPECT_THROW(sidescan_of(XtfFile()), Error);
}

}  // namespace
}  // namespace bathyal
