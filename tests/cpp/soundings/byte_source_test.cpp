// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/byte_source.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/file_limit.hpp"

namespace bathyal {
namespace {

using namespace soundings;

namespace fs = std::filesystem;

class ByteSourceTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    ::unsetenv("BATHYAL_MOST_BYTES");
    fs::remove_all(folder_);
  }

  std::string refusal(const fs::path& path) const {
    try {
      open_file(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  /// Of this test alone: others run at the same time.
  fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(ByteSourceTest, OnlyRegularFilesAreOpened) {
  const fs::path pipe = folder_ / "pipe";  // nobody writes to it
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(refusal(pipe).find("expected a regular file, got a pipe"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("expected a regular file"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("directory"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "none").find("No such file"), std::string::npos);
}

TEST_F(ByteSourceTest, WhatIsAppendedLaterIsNotRead) {
  const fs::path path = folder_ / "a";
  std::ofstream(path) << "abc";
  const auto source = open_file(path);
  std::ofstream(path, std::ios::app) << "def";
  EXPECT_EQ(source->bytes_left(), 3U);
  std::array<char, 8> bytes{};
  EXPECT_EQ(source->read(bytes.data(), 2), 2U);
  EXPECT_EQ(source->bytes_left(), 1U);
  EXPECT_EQ(source->read(bytes.data(), bytes.size()), 1U);
  EXPECT_EQ(source->read(bytes.data(), bytes.size()), 0U);
}

TEST_F(ByteSourceTest, OneLimitByName) {
  const fs::path path = folder_ / "a";
  std::ofstream(path) << "abc";
  EXPECT_EQ(most_bytes(), std::size_t{4} << 30U);
  ::setenv("BATHYAL_MOST_BYTES", "3", 1);
  EXPECT_EQ(refusal(path), "");
  ::setenv("BATHYAL_MOST_BYTES", "2", 1);
  EXPECT_NE(refusal(path).find("more than BATHYAL_MOST_BYTES"), std::string::npos);
  for (const char* text : {"", "two", "2x", "-1", "1e9"}) {
    ::setenv("BATHYAL_MOST_BYTES", text, 1);
    EXPECT_NE(refusal(path).find("expected a whole number of bytes"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace bathyal
