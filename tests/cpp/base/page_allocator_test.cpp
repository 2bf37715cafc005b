// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/page_allocator.hpp"

#include <gtest/gtest.h>

#include <new>
#include <numeric>

namespace bathyal {
namespace {

TEST(PageVector, BehavesAsAVector) {
  PageVector<int> numbers;
  for (int i = 0; i < 100000; ++i) numbers.push_back(i);
  numbers.resize(200000);
  std::iota(numbers.begin() + 100000, numbers.end(), 100000);
  const PageVector<int> copy = numbers;
  numbers.clear();
  numbers.shrink_to_fit();
  ASSERT_EQ(copy.size(), 200000U);
  for (int i = 0; i < 200000; ++i) ASSERT_EQ(copy[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(PageVector<int>(3, 7), (PageVector<int>{7, 7, 7}));
}

TEST(PageVector, ReportsThatThereIsNoMemory) {
  PageVector<char> bytes;
  EXPECT_THROW(bytes.reserve(std::size_t{1} << 62U), std::bad_alloc);
}

}  // namespace
}  // namespace bathyal
