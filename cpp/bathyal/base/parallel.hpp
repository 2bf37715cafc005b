// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace bathyal {

/// The number of threads that `num_threads` means: 0 is all of the machine's, any other number is
/// itself (1 runs in the calling thread). Throws std::invalid_argument below 0.
int resolve_threads(int num_threads);

/// Splits [0, count) into chunks of `grain` (the last may be shorter) and calls
/// `body(begin, end)` once for each, on `num_threads` threads of the one pool; returns when all are
/// done. The chunks depend on `count` and `grain` only, so what each writes to its own slots is the
/// same for any number of threads. The first exception by chunk order is thrown on in the caller.
/// A call from inside a body runs serially. `grain` of 0 counts as 1.
void parallel_for(std::size_t count, std::size_t grain, int num_threads,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Sum over fixed chunks, added in chunk order: the same bytes for any number of threads.
/// `body(begin, end)` returns the chunk's value; `Value` needs `+=` and a default that is zero.
template <class Value, class Body>
Value parallel_sum(std::size_t count, std::size_t grain, int num_threads, const Body& body) {
  if (grain == 0) grain = 1;
  std::vector<Value> parts((count + grain - 1) / grain);
  parallel_for(count, grain, num_threads, [&](std::size_t begin, std::size_t end) {
    parts[begin / grain] = body(begin, end);
  });
  Value total{};
  for (const Value& part : parts) total += part;
  return total;
}

}  // namespace bathyal
