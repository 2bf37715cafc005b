// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "bathyal/base/parallel.hpp"

namespace bathyal::soundings {

/// Sorts by a strict order in which no two values are equal, so that there is one result for any
/// number of threads: runs of fixed length are sorted and then merged in pairs.
template <class Value, class Less>
void parallel_sort(std::vector<Value>& values, const Less& less, int num_threads) {
  constexpr std::size_t kRun = std::size_t{1} << 15U;
  const std::size_t count = values.size();
  parallel_for(count, kRun, num_threads, [&](std::size_t begin, std::size_t end) {
    std::sort(values.begin() + static_cast<std::ptrdiff_t>(begin),
              values.begin() + static_cast<std::ptrdiff_t>(end), less);
  });
  if (count <= kRun) return;
  std::vector<Value> other(count);
  for (std::size_t run = kRun; run < count; run *= 2) {
    parallel_for(count, 2 * run, num_threads, [&](std::size_t begin, std::size_t end) {
      const Value* const first = values.data() + begin;
      const Value* const middle = values.data() + std::min(begin + run, end);
      const Value* const last = values.data() + end;
      std::merge(first, middle, middle, last, other.data() + begin, less);
    });
    values.swap(other);
  }
}

}  // namespace bathyal::soundings
