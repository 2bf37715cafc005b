// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bathyal {
namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 8}) {
    std::vector<std::atomic<int>> visits(1003);
    parallel_for(visits.size(), 10, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST(Parallel, SumIsTheSameBytesForAnyNumberOfThreads) {
  const auto sum = [](int threads) {
    return parallel_sum<double>(100000, 64, threads, [](std::size_t begin, std::size_t end) {
      double part = 0.0;
      for (std::size_t i = begin; i < end; ++i) part += std::sin(static_cast<double>(i)) * 1e-3;
      return part;
    });
  };
  EXPECT_EQ(sum(1), sum(8));
}

TEST(Parallel, ThrowsTheFirstFailureByChunkOrder) {
  try {
    parallel_for(100, 1, 4, [](std::size_t begin, std::size_t) {
      if (begin >= 40) throw std::runtime_error(std::to_string(begin));
    });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "40");
  }
}

TEST(Parallel, NestedCallsAndNothingToDoEnd) {
  std::atomic<int> count{0};
  parallel_for(8, 1, 4, [&](std::size_t, std::size_t) {
    parallel_for(8, 1, 4, [&](std::size_t, std::size_t) { ++count; });
  });
  parallel_for(0, 1, 4, [&](std::size_t, std::size_t) { ++count; });
  EXPECT_EQ(count, 64);
}

TEST(Parallel, RefusesANegativeNumberOfThreads) {
  EXPECT_THROW(resolve_threads(-1), std::invalid_argument);
  EXPECT_GE(resolve_threads(0), 1);
}

}  // namespace
}  // namespace bathyal
