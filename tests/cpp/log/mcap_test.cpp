// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/log/mcap.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

std::string path_of(const std::string& name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream all;
  all << file.rdbuf();
  return all.str();
}

std::string text_of(int number) {
  std::string text("message ");
  return text.append(std::to_string(number)).append(static_cast<std::size_t>(number % 40), 'x');
}

void write_some(McapWriter& writer, int from, int to) {
  for (int i = from; i < to; ++i) {
    writer.write(static_cast<std::uint16_t>(1 + i % 2), static_cast<std::uint64_t>(1000 + i),
                 text_of(i));
  }
}

void add_channels(McapWriter& writer) {
  const auto schema = writer.add_schema({"number", "jsonschema", "{}"});
  writer.add_channel({schema, "/even", "json"});
  writer.add_channel({schema, "/odd", "json"});
}

TEST(Crc32, IsZlibs) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(Mcap, EveryMessageComesBack) {
  const std::string path = path_of("bathyal_mcap_all.mcap");
  McapWriter writer(path, 4096);
  add_channels(writer);
  write_some(writer, 0, 1000);
  writer.close();
  int next = 0;
  const std::string reason = read_mcap(bytes_of(path), [&](const McapMessage& message) {
    EXPECT_EQ(message.data, text_of(next));
    EXPECT_EQ(message.topic, next % 2 == 0 ? "/even" : "/odd");
    EXPECT_EQ(message.time, static_cast<std::uint64_t>(1000 + next));
    EXPECT_EQ(message.schema, "number");
    ++next;
  });
  EXPECT_EQ(reason, "");
  EXPECT_EQ(next, 1000);
  std::filesystem::remove(path);
}

TEST(Mcap, AFileCutAtAnyByteGivesAllWholeMessages) {
  const std::string path = path_of("bathyal_mcap_cut.mcap");
  McapWriter writer(path, 512);
  add_channels(writer);
  write_some(writer, 0, 120);
  writer.close();
  const std::string whole = bytes_of(path);
  int before = 0;
  for (std::size_t size = 8; size < whole.size(); ++size) {
    int count = 0;
    const std::string reason =
        read_mcap(std::string_view(whole).substr(0, size), [&](const McapMessage& message) {
          EXPECT_EQ(message.data, text_of(count));
          ++count;
        });
    EXPECT_NE(reason, "") << size;
    EXPECT_GE(count, before);
    before = count;
  }
  EXPECT_EQ(before, 120);
  std::filesystem::remove(path);
}

TEST(Mcap, AContinuedFileHasTheSameBytes) {
  const std::string one = path_of("bathyal_mcap_one.mcap"), two = path_of("bathyal_mcap_two.mcap");
  McapWriter writer(one, 700);
  add_channels(writer);
  write_some(writer, 0, 200);
  writer.close();
  for (const int moment : {0, 1, 77, 199}) {
    McapWriterState state;
    {
      McapWriter first(two, 700);
      add_channels(first);
      write_some(first, 0, moment);
      state = first.state();
      write_some(first, moment, std::min(200, moment + 50));  // lost
    }
    McapWriter second(two, state, 700);
    write_some(second, moment, 200);
    second.close();
    EXPECT_EQ(bytes_of(one), bytes_of(two)) << moment;
  }
  std::filesystem::remove(one);
  std::filesystem::remove(two);
}

TEST(Mcap, HostileBytesAreRefusedOrReported) {
  EXPECT_THROW(read_mcap("", [](const McapMessage&) {}), Error);
  EXPECT_THROW(read_mcap("not an MCAP file", [](const McapMessage&) {}), Error);
  const std::string path = path_of("bathyal_mcap_hostile.mcap");
  McapWriter writer(path, 512);
  add_channels(writer);
  write_some(writer, 0, 50);
  writer.close();
  const std::string whole = bytes_of(path);
  RandomStream random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes = whole;
    const auto at = static_cast<std::size_t>(random.next() % bytes.size());
    bytes[at] = static_cast<char>(random.next());
    if (i % 3 == 0) bytes.resize(bytes.size() - random.next() % bytes.size());
    try {
      read_mcap(bytes, [](const McapMessage&) {});
    } catch (const Error&) {
    }
  }
  std::filesystem::remove(path);
}

TEST(Mcap, PathsThatCannotBeWrittenAreNamed) {
  try {
    const McapWriter writer("/no/such/folder/log.mcap");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/log.mcap"), std::string::npos);
  }
}

}  // namespace
}  // namespace bathyal
