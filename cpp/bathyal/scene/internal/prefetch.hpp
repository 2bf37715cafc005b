// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace bathyal::scene {

/// Prefetches every cache line of a value that is soon read.
/// Always inlined: a copy compiled for one instruction set must not be called by another.
template <class T>
[[gnu::always_inline]] inline void prefetch(const T& value) {
  constexpr std::size_t kLine = 64;
  const char* first = reinterpret_cast<const char*>(&value);
  for (std::size_t at = 0; at < sizeof(T); at += kLine) __builtin_prefetch(first + at);
}

/// The same for three numbers in a row, which may lie on two cache lines.
template <class T>
[[gnu::always_inline]] inline void prefetch_three(const T* first) {
  __builtin_prefetch(first);
  __builtin_prefetch(first + 2);
}

}  // namespace bathyal::scene
