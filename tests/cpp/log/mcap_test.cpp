// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/log/mcap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/log/crc32.hpp"

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

std::uint32_t crc_bit_by_bit(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

TEST(Crc32, IsZlibs) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(Crc32, IsTheSameAtEverySizeAndInstructionSet) {
  RandomStream random(1);
  std::string bytes(70'000, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.next());
  const SimdLevel before = simd_level();
  for (const SimdLevel level : available_simd_levels()) {
    set_simd_level(level);
    for (std::size_t size = 0; size < 400; ++size) {
      const std::string_view part = std::string_view(bytes).substr(size % 7, size);
      ASSERT_EQ(crc32(part), crc_bit_by_bit(part)) << to_text(level) << ' ' << size;
    }
    EXPECT_EQ(crc32(bytes), crc_bit_by_bit(bytes)) << to_text(level);
  }
  set_simd_level(before);
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

// A reader goes through a file once, so that of the chunks before the one that is cut the first,
// with schemas and channels, is enough.
TEST(Mcap, AMegabyteCutAtAnyByteGivesAllWholeMessages) {
  constexpr std::size_t kBeforeRecords = 49, kBeforeData = 31;  // bytes, of a chunk and a message
  const std::string path = path_of("bathyal_mcap_megabyte.mcap");
  McapWriter writer(path, 1024);
  add_channels(writer);
  std::vector<std::size_t> ends;
  for (int i = 0; writer.state().written < 1'000'000; ++i) {
    ends.push_back(writer.state().written + kBeforeRecords + writer.state().pending.size() +
                   kBeforeData + text_of(i).size());
    write_some(writer, i, i + 1);
  }
  writer.close();
  const std::string whole = bytes_of(path);
  ASSERT_GT(whole.size(), 1'000'000U);
  const std::vector<McapChunk>& chunks = writer.state().chunks;
  const auto in_first = static_cast<std::size_t>(
      std::upper_bound(ends.begin(), ends.end(), chunks[1].start) - ends.begin());
  const std::string first = whole.substr(0, chunks[1].start);
  for (std::size_t k = 1; k < chunks.size(); ++k) {
    const std::size_t from = chunks[k].start;
    const std::size_t to = k + 1 < chunks.size() ? chunks[k + 1].start : whole.size();
    const auto before =
        static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), from) - ends.begin());
    const std::string file = first + whole.substr(from, to - from);
    std::size_t due = before;
    for (std::size_t cut = from; cut < to; ++cut) {
      while (due < ends.size() && ends[due] <= cut) ++due;
      std::size_t count = 0;
      const std::string reason =
          read_mcap(std::string_view(file).substr(0, first.size() + cut - from),
                    [&](const McapMessage& message) {
                      const std::size_t row = count < in_first ? count : before + count - in_first;
                      ASSERT_EQ(message.time, 1000 + row);
                      ++count;
                    });
      ASSERT_NE(reason, "") << cut;
      ASSERT_EQ(before + count - in_first, due) << cut;
    }
  }
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
