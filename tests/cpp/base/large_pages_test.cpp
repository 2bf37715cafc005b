// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <utility>

#include "bathyal/base/page_array.hpp"

namespace bathyal {
namespace {

struct Free {
  void operator()(void* p) const { std::free(p); }
};
using Memory = std::unique_ptr<void, Free>;

bool starts_on(const void* memory, std::size_t border) {
  return reinterpret_cast<std::uintptr_t>(memory) % border == 0;
}

/// Whether large pages were requested of the system where `address` lies ("hg" of its mapping).
bool is_asked_for(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  std::string line;
  bool inside = false;
  while (std::getline(maps, line)) {
    std::istringstream words(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-') {
      inside = begin <= wanted && wanted < end;
    }
    if (inside && line.rfind("VmFlags:", 0) == 0) return line.find(" hg") != std::string::npos;
  }
  return false;
}

bool knows_large_pages() {
  return std::filesystem::exists("/sys/kernel/mm/transparent_hugepage/enabled") &&
         std::filesystem::exists("/proc/self/smaps");
}

TEST(LargePages, ServeBigBlocksOfTheHeapOnly) {
  const Memory small(allocate_large(100));
  EXPECT_TRUE(starts_on(small.get(), 64));
  const Memory big(allocate_large(5 * kLargePage + 1));
  ASSERT_TRUE(starts_on(big.get(), kLargePage));
  std::memset(big.get(), 1, 6 * kLargePage);  // the last page is whole
  if (!knows_large_pages()) GTEST_SKIP() << "this system has no transparent large pages";
  EXPECT_TRUE(is_asked_for(big.get()));
  EXPECT_FALSE(is_asked_for(small.get()));
}

TEST(LargePages, KeepTheirValuesWhenTheHeapMovesThem) {
  auto* values = static_cast<unsigned char*>(allocate_large(kLargePage));
  ASSERT_NE(values, nullptr);
  std::memset(values, 7, kLargePage);
  values = static_cast<unsigned char*>(std::realloc(values, 9 * kLargePage));
  const Memory owner(values);
  for (std::size_t i = 0; i < kLargePage; i += 1000) ASSERT_EQ(values[i], 7);
}

TEST(LargePages, AreMappedAndReadAsNothing) {
  const std::size_t bytes = 3 * kLargePage;
  auto* const pages = static_cast<unsigned char*>(map_pages(bytes));
  for (std::size_t i = 0; i < bytes; i += 1000) ASSERT_EQ(pages[i], 0);
  const bool asked = is_asked_for(pages);
  unmap_pages(pages, bytes);
  if (!knows_large_pages()) GTEST_SKIP() << "this system has no transparent large pages";
  EXPECT_TRUE(asked);
}

TEST(LargePages, ReportThatThereIsNoMemory) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(allocate_large(kMost), nullptr);
  EXPECT_EQ(allocate_large(std::size_t{1} << 62U), nullptr);
  EXPECT_THROW(map_pages(std::size_t{1} << 62U), std::bad_alloc);
  EXPECT_THROW(PageArray<double>{kMost / 4}, std::bad_alloc);
}

TEST(PageArray, HoldsWhatItIsGiven) {
  EXPECT_TRUE(PageArray<int>().empty());
  EXPECT_TRUE(PageArray<int>(0).empty());
  for (const std::size_t size : {std::size_t{3}, kLargePage}) {
    PageArray<std::uint32_t> array(size);
    for (std::size_t i = 0; i < size; ++i) array[i] = static_cast<std::uint32_t>(i);
    const PageArray<std::uint32_t> moved = std::move(array);
    EXPECT_EQ(moved.size(), size);
    EXPECT_EQ(moved.bytes(), 4 * size);
    std::uint32_t expected = 0;
    for (const std::uint32_t value : moved) ASSERT_EQ(value, expected++);
  }
}

}  // namespace
}  // namespace bathyal
