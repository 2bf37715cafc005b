// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/file_limit.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"

namespace bathyal {

std::size_t most_bytes() {
  constexpr std::size_t kDefault = std::size_t{4} << 30U;
  const char* const text = std::getenv("BATHYAL_MOST_BYTES");
  if (text == nullptr) return kDefault;
  std::size_t value = 0;
  const char* const end = text + std::strlen(text);
  const auto [stop, code] = std::from_chars(text, end, value);
  if (code != std::errc{} || stop != end) {
    throw Error("BATHYAL_MOST_BYTES: expected a whole number of bytes, got " +
                soundings::printable(text));
  }
  return value;
}

void check_bytes(const std::string& what, double bytes) {
  const auto most = static_cast<double>(most_bytes());
  if (!(bytes > most)) return;
  constexpr double kMega = 1e6;
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), " takes %.6g MB, more than BATHYAL_MOST_BYTES (%.6g MB)",
                std::ceil(bytes / kMega), most / kMega);
  throw Error(what + text.data() + ": set it in the environment to read more");
}

}  // namespace bathyal
