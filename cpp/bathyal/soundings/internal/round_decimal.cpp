// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/round_decimal.hpp"

namespace bathyal::soundings::number {

double divide_exactly(std::uint64_t digits, int power) {
  const Five& five = kFives[static_cast<std::size_t>(power)];
  const int shift = std::countl_zero(digits);
  const Wide dividend = Wide{digits << shift} << 63U;
  auto quotient = static_cast<std::uint64_t>(dividend / five.value);
  if (Wide{quotient} * five.value != dividend) quotient |= 1U;
  return scale_quotient(quotient, five.exponent - shift);
}

}  // namespace bathyal::soundings::number
