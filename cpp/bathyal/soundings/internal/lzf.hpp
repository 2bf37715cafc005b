// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace bathyal::soundings {

/// The most bytes that one byte of LZF data can become: three bytes copy up to 264.
inline constexpr std::size_t kLzfMostGrowth = 88;

/// Unpacks LZF data (the format of Marc Lehmann's LibLZF) into exactly `size` bytes at `to`. False
/// when the data end early, reach behind what has been written, or make more or fewer bytes.
bool unpack_lzf(std::string_view packed, char* to, std::size_t size);

}  // namespace bathyal::soundings
