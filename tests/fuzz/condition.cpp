// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

#include "bathyal/mission/condition.hpp"

// Any text is a condition, which holds or does not, or is refused.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const std::array<std::string, 4> kSignals{"depth", "time", "battery", "fault.dvl"};
  static const std::array<std::string, 4> kUnits{"m", "s", "1", "1"};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::array<double, 4> values{3.0, 60.0, 0.5, std::numeric_limits<double>::quiet_NaN()};
  try {
    (void)bathyal::Condition(text, kSignals, kUnits).holds(values);
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
