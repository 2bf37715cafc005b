// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/pcd.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/internal/lzf.hpp"
#include "bathyal/soundings/internal/pcd_header.hpp"

namespace bathyal {
namespace {

using namespace soundings;

std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                   const std::string& counts, const std::string& width, const std::string& data,
                   const std::string& height = "1") {
  std::string text("# .PCD v0.7\nVERSION 0.7\nFIELDS ");
  text.append(fields).append("\nSIZE ").append(sizes).append("\nTYPE ").append(types);
  text.append("\nCOUNT ").append(counts).append("\nWIDTH ").append(width).append("\nHEIGHT ");
  text.append(height).append("\nVIEWPOINT 0 0 0 1 0 0 0\nDATA ").append(data).append("\n");
  return text;
}

template <class... Scalars>
std::string bytes_of(Scalars... scalars) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&scalars), sizeof scalars), ...);
  return bytes;
}

/// LZF without any compression: literal runs of up to 32 bytes.
std::string pack(const std::string& raw) {
  std::string packed;
  for (std::size_t i = 0; i < raw.size(); i += 32) {
    const std::string run = raw.substr(i, 32);
    packed += static_cast<char>(run.size() - 1);
    packed += run;
  }
  return packed;
}

std::string compressed(const std::string& packed, std::size_t size) {
  return bytes_of(static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(size)) +
         packed;
}

std::string failure(const std::string& bytes) {
  try {
    parse_pcd(bytes, 1, "f.pcd");
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

const std::string kXyz = header("x y z", "4 4 4", "F F F", "1 1 1", "2", "ascii");

TEST(Pcd, ReadsAscii) {
  const PointCloud cloud = parse_pcd(kXyz + "1 2 3\n4.5 5 nan\n");
  ASSERT_EQ(cloud.size(), 2);
  EXPECT_EQ(cloud.points()(1, 0), 4.5);
  EXPECT_TRUE(std::isnan(cloud.points()(1, 2)));
  EXPECT_TRUE(cloud.attributes().empty());
}

TEST(Pcd, ReadsTheOldestHeader) {
  const PointCloud cloud = parse_pcd(
      "VERSION .5\r\nCOLUMNS z y x\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 1\r\nDATA ascii\r\n1 2 "
      "3\r\n");
  EXPECT_EQ(cloud.points().row(0), Eigen::RowVector3d(3, 2, 1));
}

TEST(Pcd, ReadsEveryTypeAndTakesColoursApart) {
  const std::string head =
      header("_ x y z a b c d e f g rgba", "1 8 4 2 1 1 2 4 8 8 4 4", "U F F I I U U I I U F U",
             "3 1 1 1 1 1 1 1 1 1 2 1", "1", "binary");
  const std::string data =
      bytes_of('\1', '\2', '\3', 620152.873, 2.5F, std::int16_t{-7}, std::int8_t{-1},
               std::uint8_t{255}, std::uint16_t{65535}, std::int32_t{-2147483647},
               std::int64_t{-9007199254740992}, std::uint64_t{1} << 63U, 0.5F, 0.25F, 0xff102030U);
  const PointCloud cloud = parse_pcd(head + data);
  EXPECT_EQ(cloud.points().row(0), Eigen::RowVector3d(620152.873, 2.5, -7));
  const std::vector<std::pair<std::string, double>> expected = {
      {"a", -1},     {"b", 255},    {"c", 65535}, {"d", -2147483647.0}, {"e", -9007199254740992.0},
      {"f", 0x1p63}, {"g_0", .5},   {"g_1", .25}, {"red", 16},          {"green", 32},
      {"blue", 48},  {"alpha", 255}};
  EXPECT_EQ(cloud.attributes().size(), expected.size());
  for (const auto& [name, value] : expected) {
    ASSERT_EQ(cloud.attributes().count(name), 1U) << name;
    EXPECT_EQ(cloud.attributes().at(name).data()[0], value) << name;
  }
}

TEST(Pcd, TakesColoursApartFromTextToo) {
  const std::string text = to_text(static_cast<double>(std::bit_cast<float>(0x00102030U)));
  const auto red_green_blue = [](const PointCloud& cloud) {
    return Vec3(cloud.attributes().at("red").data()[0], cloud.attributes().at("green").data()[0],
                cloud.attributes().at("blue").data()[0]);
  };
  EXPECT_EQ(
      red_green_blue(parse_pcd(header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", "1", "ascii") +
                               "1 2 3 " + text)),
      Vec3(16, 32, 48));
  EXPECT_EQ(
      red_green_blue(parse_pcd(header("x y z rgb", "4 4 4 4", "F F F U", "1 1 1 1", "1", "ascii") +
                               "1 2 3 1056816\n")),
      Vec3(16, 32, 48));
}

TEST(Pcd, ReadsCompressedFieldByField) {
  const std::string head =
      header("x i y z", "4 2 4 4", "F U F F", "1 1 1 1", "2", "binary_compressed");
  const std::string raw =
      bytes_of(1.F, 2.F, std::uint16_t{7}, std::uint16_t{8}, 3.F, 4.F, 5.F, 6.F);
  const PointCloud cloud = parse_pcd(head + compressed(pack(raw), raw.size()));
  EXPECT_EQ(cloud.points().row(0), Eigen::RowVector3d(1, 3, 5));
  EXPECT_EQ(cloud.points().row(1), Eigen::RowVector3d(2, 4, 6));
  EXPECT_EQ(cloud.attributes().at("i").data()[1], 8.0);
}

TEST(Pcd, IsTheSameForAnyNumberOfThreads) {
  std::string text = header("x y z i", "4 4 4 4", "F F F F", "1 1 1 1", "300", "ascii", "500");
  for (int i = 0; i < 150000; ++i)
    text += std::to_string(i) + " 2 3 " + std::to_string(i % 7) + "\n";
  const PointCloud one = parse_pcd(text, 1);
  const PointCloud eight = parse_pcd(text, 8);
  EXPECT_EQ(one.points(), eight.points());
  EXPECT_EQ(one.attributes().at("i").view(), eight.attributes().at("i").view());
  EXPECT_EQ(one.points()(149999, 0), 149999.0);
}

TEST(Pcd, RefusesHeadersThatContradictThemselves) {
  EXPECT_EQ(failure(""), "f.pcd: the file is empty");
  EXPECT_NE(failure("FIELDS x y z\n").find("no DATA line"), std::string::npos);
  EXPECT_EQ(failure("ply\n"), "f.pcd:1: expected a line of a PCD header, got \"ply\"");
  EXPECT_EQ(failure(std::string("\x89PNG\0\n", 6)),
            "f.pcd:1: expected a line of a PCD header, got \"\\x89PNG\\x00\"");
  EXPECT_EQ(failure(header("x y", "4 4", "F F", "1 1", "2", "ascii") + "1 2\n3 4\n"),
            "f.pcd:3: expected a field z of one number");
  EXPECT_NE(
      failure(header("x y z", "4 4 4", "F F F", "1 2 1", "1", "ascii")).find("a field y of one"),
      std::string::npos);
  EXPECT_NE(failure(header("x y z x", "4 4 4 4", "F F F F", "1 1 1 1", "1", "ascii"))
                .find("field x for the second time"),
            std::string::npos);
  EXPECT_NE(failure(header("x y z rgb red", "4 4 4 4 4", "F F F U F", "1 1 1 1 1", "1", "ascii") +
                    "1 2 3 4 5\n")
                .find("two fields give the attribute red"),
            std::string::npos);
  EXPECT_NE(
      failure(header("x y z", "4 4", "F F F", "1 1 1", "1", "ascii")).find("expected 3 words"),
      std::string::npos);
  EXPECT_NE(
      failure(header("x y z", "4 4 3", "F F F", "1 1 1", "1", "ascii")).find("no type F of 3"),
      std::string::npos);
  EXPECT_NE(
      failure(header("x y z", "4 4 4", "F F Q", "1 1 1", "1", "ascii")).find("no type Q of 4"),
      std::string::npos);
  EXPECT_NE(failure(header("x y z", "4 4 -4", "F F F", "1 1 1", "1", "ascii"))
                .find("expected a whole number of 0 or more, got \"-4\""),
            std::string::npos);
  EXPECT_NE(
      failure(header("x y z", "4 4 4", "F F F", "1 1 0", "1", "ascii")).find("numbers a point"),
      std::string::npos);
  EXPECT_NE(failure(header("x y z w", "4 4 4 4", "F F F F", "1 1 1 99999999999", "1", "ascii"))
                .find("numbers a point"),
            std::string::npos);
  EXPECT_NE(failure(header("x y z", "4 4 4", "F F F", "1 1 1", "-1", "ascii")).find("got \"-1\""),
            std::string::npos);
  EXPECT_NE(
      failure(header("x y z", "4 4 4", "F F F", "1 1 1", "0", "ascii")).find("holds no point"),
      std::string::npos);
  EXPECT_NE(failure(header("x y z", "4 4 4", "F F F", "1 1 1", "1", "zip")).find("got \"zip\""),
            std::string::npos);
  EXPECT_NE(
      failure("POINTS 5\n" + kXyz + "1 2 3\n4 5 6\n").find("POINTS is not WIDTH × HEIGHT = 2"),
      std::string::npos);
  EXPECT_NE(failure("WIDTH 2\n" + kXyz).find("WIDTH for the second time"), std::string::npos);
}

TEST(Pcd, BelievesAHeaderNoFurtherThanItsBytes) {
  const auto head = [](const char* width, const char* height, const char* data) {
    return header("x y z", "4 4 4", "F F F", "1 1 1", width, data, height);
  };
  EXPECT_NE(failure(head("4294967296", "4294967296", "binary")).find("more than any file holds"),
            std::string::npos);
  EXPECT_NE(failure(head("99999999999999999999", "1", "binary")).find("whole number"),
            std::string::npos);
  EXPECT_NE(failure(head("1000000000", "1", "binary") + "abc").find("BATHYAL_MOST_BYTES"),
            std::string::npos);
  EXPECT_EQ(failure(head("100000000", "1", "binary") + "abc"),
            "f.pcd: cut short: expected 1200000000 bytes of points, got 3");
  EXPECT_NE(failure(head("100000000", "1", "ascii") + "1 2 3\n").find("expected 100000000 points"),
            std::string::npos);
  EXPECT_NE(failure(head("100000000", "1", "binary_compressed") + compressed("abcde", 1200000000U))
                .find("5 packed bytes said to hold 1200000000"),
            std::string::npos);
  EXPECT_EQ(failure(head("1", "1", "binary_compressed") + bytes_of(1000000U, 12U)),
            "f.pcd: cut short: expected 1000000 bytes of points, got 0");
  EXPECT_EQ(failure(head("1", "1", "binary_compressed") + "abc"),
            "f.pcd: cut short: expected 8 bytes of points, got 3");
  EXPECT_EQ(failure(kXyz + "1 2 3\n"), "f.pcd: expected 2 points, got 1");
  EXPECT_EQ(failure(kXyz + "1 2 3\n1 2 3\n1 2 3\n"), "f.pcd: expected 2 points, got 3");
  EXPECT_EQ(failure(kXyz + "1 2 3\n1 2 x\n"),
            "f.pcd:12: expected a number in column 2, got \"x\", in \"1 2 x\"");
}

TEST(Lzf, UnpacksRunsAndCopiesThatRunIntoThemselves) {
  std::string out(10, '.');
  EXPECT_TRUE(unpack_lzf(std::string("\0a\xe0\0\0", 5), out.data(), 10));  // a, then 9 from 1 back
  EXPECT_EQ(out, "aaaaaaaaaa");
  EXPECT_TRUE(unpack_lzf(std::string("\2abc\x20\2", 6), out.data(), 6));  // abc, 3 from 3 back
  EXPECT_EQ(out.substr(0, 6), "abcabc");
}

TEST(Lzf, RefusesDamage) {
  std::string out(16, '.');
  const auto unpacks = [&](const std::string& packed, std::size_t size) {
    return unpack_lzf(packed, out.data(), size);
  };
  EXPECT_FALSE(unpacks(std::string("\3ab", 3), 4));            // the run ends early
  EXPECT_FALSE(unpacks(std::string("\1ab", 3), 1));            // more than wanted
  EXPECT_FALSE(unpacks(std::string("\1ab", 3), 3));            // less than wanted
  EXPECT_FALSE(unpacks(std::string("\x20\0", 2), 3));          // reaches behind the beginning
  EXPECT_FALSE(unpacks(std::string("\0a\x20\1", 4), 4));       // the same, later
  EXPECT_FALSE(unpacks(std::string("\0a\x20", 3), 4));         // no distance
  EXPECT_FALSE(unpacks(std::string("\0a\xe0", 3), 10));        // no length
  EXPECT_FALSE(unpacks(std::string("\0a\xe0\xff\0", 5), 10));  // a copy beyond the end
}

TEST(PcdHeader, CountsBytesAndColumns) {
  const std::string text =
      header("x y z _ rgb", "8 8 8 1 4", "F F F U U", "1 1 1 4 1", "3", "binary");
  const PcdHeader read = read_pcd_header(text + "data", "test");
  EXPECT_EQ(read.points, 3U);
  EXPECT_EQ(read.point_size, 32U);
  EXPECT_EQ(read.columns, 8U);
  EXPECT_EQ(read.bytes, text.size());
  EXPECT_EQ(read.data, PcdData::kBinary);
  ASSERT_NE(read.find("rgb"), nullptr);
  EXPECT_EQ(read.find("rgb")->offset, 28U);
  EXPECT_EQ(read.find("rgb")->column, 7U);
  EXPECT_EQ(read.find("intensity"), nullptr);
}

}  // namespace
}  // namespace bathyal
