// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/lzf.hpp"

#include <cstring>

namespace bathyal::soundings {

// A control byte below 32 is followed by that many bytes plus one, as they are. Any other says to
// copy what was written before: its upper three bits are the length less two (7: one more byte adds
// to it), its lower five and the next byte the distance less one.
bool unpack_lzf(std::string_view packed, char* to, std::size_t size) {
  std::size_t in = 0;
  std::size_t out = 0;
  const auto next = [&] {
    return static_cast<std::size_t>(static_cast<unsigned char>(packed[in++]));
  };
  while (in < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - in || length > size - out) return false;
      std::memcpy(to + out, packed.data() + in, length);
      in += length;
      out += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (in == packed.size()) return false;
      length += next();
    }
    length += 2;
    if (in == packed.size()) return false;
    const std::size_t distance = ((control & 31U) << 8U) + next() + 1;
    if (distance > out || length > size - out) return false;
    // Byte by byte: the copy may run into what it writes.
    for (std::size_t i = 0; i < length; ++i, ++out) to[out] = to[out - distance];
  }
  return out == size;
}

}  // namespace bathyal::soundings
