// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

namespace bathyal {

/// CRC-32 (ISO 3309), as zlib's; the same at every SimdLevel.
std::uint32_t crc32(std::string_view bytes);

}  // namespace bathyal
