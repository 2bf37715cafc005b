// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/nmea.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

NmeaFix harbour() {
  NmeaFix fix;
  fix.time = 12 * 3600 + 35 * 60 + 19.25;
  fix.day = 7, fix.month = 6, fix.year = 2026;
  fix.latitude = -43.123456789;
  fix.longitude = 131.9;
  fix.altitude = 12.5;
  fix.speed = 1852.0 / 3600.0;
  fix.course = 84.4;
  return fix;
}

std::vector<std::string> read_all(NmeaReader& reader, std::string_view bytes) {
  std::vector<std::string> bodies;
  reader.feed(bytes, [&bodies](std::string_view body) { bodies.emplace_back(body); });
  return bodies;
}

TEST(Nmea, ASentenceHasThePublishedChecksum) {
  // the example of many manuals
  EXPECT_EQ(nmea_sentence("GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,"),
            "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n");
}

TEST(Nmea, APositionIsWrittenWithFiveDecimalsOfAMinute) {
  EXPECT_EQ(nmea_gga(harbour()).substr(0, 71),
            "$GPGGA,123519.250,4307.40741,S,13154.00000,E,1,09,0.9,12.500,M,0.0,M,,*");
  EXPECT_EQ(nmea_rmc(harbour()).substr(0, 66),
            "$GPRMC,123519.250,A,4307.40741,S,13154.00000,E,1.000,84.40,070626,");
  const NmeaFix again = read_gga(nmea_gga(harbour()).substr(1));
  EXPECT_NEAR(again.latitude, harbour().latitude, 0.5e-5 / 60.0 + 1e-12);
  EXPECT_NEAR(again.longitude, 131.9, 1e-12);
  EXPECT_NEAR(again.time, harbour().time, 1e-9);
  EXPECT_EQ(again.altitude, 12.5);
}

TEST(Nmea, MinutesThatRoundToSixtyAreADegree) {
  NmeaFix fix = harbour();
  fix.latitude = 42.99999999999;
  fix.time = 86'399.9996;
  EXPECT_EQ(nmea_gga(fix).substr(0, 31), "$GPGGA,000000.000,4300.00000,N,");
}

TEST(Nmea, WhatIsNotKnownIsLeftOut) {
  NmeaFix fix = harbour();
  fix.valid = false;
  EXPECT_NE(nmea_gga(fix).find(",,,,0,00,"), std::string::npos);
  EXPECT_FALSE(read_gga(nmea_gga(fix).substr(1)).valid);
  EXPECT_NE(nmea_rmc(fix).find(",V,"), std::string::npos);
  EXPECT_EQ(nmea_vbw(0.0, 0.0, false).substr(0, 15), "$VDVBW,,,V,,,V*");
}

TEST(Nmea, HeadingsAndDepths) {
  EXPECT_EQ(nmea_hdt(-90.0).substr(0, 15), "$HEHDT,270.00,T");
  EXPECT_EQ(nmea_hdt(359.999).substr(0, 13), "$HEHDT,0.00,T");
  EXPECT_EQ(nmea_dpt(12.3456).substr(0, 17), "$SDDPT,12.346,0.0");
  // 1 m/s ahead is 1.944 knots; to port is negative
  EXPECT_EQ(nmea_vbw(1.0, 0.5, true).substr(0, 26), "$VDVBW,,,V,1.944,-0.972,A*");
}

TEST(Nmea, AStreamIsReadInPiecesOfAnySize) {
  const std::string text = nmea_gga(harbour()) + nmea_hdt(12.0);
  for (std::size_t size = 1; size < text.size(); ++size) {
    NmeaReader reader;
    std::vector<std::string> bodies;
    for (std::size_t at = 0; at < text.size(); at += size) {
      for (auto& body : read_all(reader, std::string_view(text).substr(at, size))) {
        bodies.push_back(std::move(body));
      }
    }
    ASSERT_EQ(bodies.size(), 2U) << size;
    EXPECT_EQ(bodies[1], "HEHDT,12.00,T");
  }
}

TEST(Nmea, EverySingleBitErrorIsSeen) {
  const std::string text = nmea_hdt(12.0);
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string turned = text;
      turned[i] = static_cast<char>(static_cast<unsigned char>(turned[i]) ^ (1U << bit));
      NmeaReader reader;
      const auto bodies = read_all(reader, turned);
      // a checksum's letter in the other case is the same number
      const bool same = turned[i] == text[i] + ('a' - 'A');
      EXPECT_EQ(bodies.size(), same && i > text.size() - 5 ? 1U : 0U) << i << " " << bit;
    }
  }
}

TEST(Nmea, HalfFramesAreCountedAndTheNextIsWhole) {
  NmeaReader reader;
  const std::string text = nmea_hdt(12.0);
  EXPECT_EQ(read_all(reader, text.substr(0, 7) + text + "noise" + text).size(), 2U);
  EXPECT_EQ(reader.counts().broken, 1U);
  EXPECT_EQ(read_all(reader, "$" + std::string(5000, 'A') + "\n").size(), 0U);
  EXPECT_EQ(reader.counts().broken, 2U);
  EXPECT_EQ(read_all(reader, "$HEHDT,12.00,T\r\n").size(), 0U);
  EXPECT_EQ(reader.counts().wrong_checksum, 1U);
}

TEST(Nmea, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(nmea_sentence(""), std::invalid_argument);
  EXPECT_THROW(nmea_sentence("GP*GGA"), std::invalid_argument);
  EXPECT_THROW(nmea_sentence("GP\nGGA"), std::invalid_argument);
  EXPECT_THROW(nmea_hdt(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(nmea_dpt(-1.0), std::invalid_argument);
  NmeaFix fix = harbour();
  fix.latitude = 90.1;
  EXPECT_THROW(nmea_gga(fix), std::invalid_argument);
  fix = harbour();
  fix.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(nmea_rmc(fix), std::invalid_argument);
  for (const char* body :
       {"GPRMC,1", "GPGGA,,,,", "GPGGA,x,1,N,1,E,1,1,1,1,M,1,M,,",
        "GPGGA,1,9160.0,N,1,E,1,1,1,1,M,1,M,,", "GPGGA,1,1,X,1,E,1,1,1,1,M,1,M,,"}) {
    EXPECT_THROW(read_gga(body), Error) << body;
  }
}

}  // namespace
}  // namespace bathyal
