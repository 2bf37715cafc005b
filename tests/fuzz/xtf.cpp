// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/formats/xtf.hpp"

#include <cstdlib>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/formats/sidescan.hpp"

// Any bytes give packets no longer than they are, and rows of one length, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  try {
    const bathyal::XtfFile file = bathyal::parse_xtf({data, size});
    if (bathyal::format_xtf(file).size() > size) std::abort();
    const bathyal::SidescanPings pings = bathyal::sidescan_of(file);
    const std::size_t rows = pings.count() * static_cast<std::size_t>(pings.rows());
    if (pings.amplitude.size() != rows * static_cast<std::size_t>(pings.samples)) std::abort();
  } catch (const bathyal::Error&) {
  }
  return 0;
}
