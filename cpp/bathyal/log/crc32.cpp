// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/log/crc32.hpp"

#include <array>
#include <cstring>

#include "bathyal/base/simd.hpp"
#include "bathyal/log/internal/crc_fold.hpp"

namespace bathyal {
namespace {

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

Tables make_tables() {
  Tables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0);
    tables[0][i] = value;
  }
  for (std::size_t k = 1; k < 8; ++k) {
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint32_t before = tables[k - 1][i];
      tables[k][i] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}

/// Eight tables: eight bytes a step (Kounavis, Berry 2005).
std::uint32_t by_tables(const unsigned char* at, std::size_t left, std::uint32_t crc) {
  static const Tables kTables = make_tables();
  for (; left >= 8; left -= 8, at += 8) {
    std::uint32_t low = 0, high = 0;
    std::memcpy(&low, at, 4);
    std::memcpy(&high, at + 4, 4);
    low ^= crc;
    crc = kTables[7][low & 0xFFU] ^ kTables[6][(low >> 8U) & 0xFFU] ^
          kTables[5][(low >> 16U) & 0xFFU] ^ kTables[4][low >> 24U] ^ kTables[3][high & 0xFFU] ^
          kTables[2][(high >> 8U) & 0xFFU] ^ kTables[1][(high >> 16U) & 0xFFU] ^
          kTables[0][high >> 24U];
  }
  for (; left > 0; --left, ++at) crc = (crc >> 8U) ^ kTables[0][(crc ^ *at) & 0xFFU];
  return crc;
}

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
#if defined(BATHYAL_X86_KERNELS)
  if (left >= crc::kLeastFolded && simd_level() != SimdLevel::kBaseline && crc::can_fold()) {
    std::array<unsigned char, 16> folded{};
    crc::fold(at, left, sum, folded.data());
    sum = by_tables(folded.data(), folded.size(), 0);
    at += left - left % 16;
    left %= 16;
  }
#endif
  return ~by_tables(at, left, sum);
}

}  // namespace bathyal
