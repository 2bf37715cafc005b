// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace bathyal {

/// What one file may take in memory, as it is and as what it unfolds to: BATHYAL_MOST_BYTES of the
/// environment, 4 GiB where that is not set. All readers share it, those in Python too.
/// \throw Error where the variable holds no whole number.
std::size_t most_bytes();

/// \throw Error that starts with `what` and names the limit, where `bytes` is above `most_bytes`.
void check_bytes(const std::string& what, double bytes);

}  // namespace bathyal
