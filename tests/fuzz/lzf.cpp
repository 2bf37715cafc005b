// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/lzf.hpp"

#include <memory>

// Unpacks into memory of exactly the size requested, so that the sanitizer sees a byte too many.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t wanted = data[0] + 256U * (data[1] % 8);
  const auto unpacked = std::make_unique<char[]>(wanted);
  bathyal::soundings::unpack_lzf({reinterpret_cast<const char*>(data) + 2, size - 2},
                                 unpacked.get(), wanted);
  return 0;
}
