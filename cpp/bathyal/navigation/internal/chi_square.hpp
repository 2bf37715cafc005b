// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal {

/// Probability that a sum of `count` squares of standard normal variables exceeds `value`
/// (Abramowitz, Stegun 1964, 26.4.4, 26.4.5). \pre count ≥ 1, value ≥ 0
double chi_square_tail(double value, int count);

}  // namespace bathyal
