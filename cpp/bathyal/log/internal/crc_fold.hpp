// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// The interface to the kernel that is compiled for one instruction set: plain numbers and pointers.

namespace bathyal::crc {

inline constexpr std::size_t kLeastFolded = 64;  ///< [bytes]

#if defined(BATHYAL_X86_KERNELS)
bool can_fold();  ///< whether this machine multiplies without carry

/// Folds bytes into 16 that have the same CRC from 0 on as all of them from `crc` on.
/// \param size at least kLeastFolded; what exceeds a multiple of 16 is left
void fold(const unsigned char* bytes, std::size_t size, std::uint32_t crc, unsigned char* folded);
#endif

}  // namespace bathyal::crc
