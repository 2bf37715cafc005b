// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal {

/// Probability that a variable of Fisher's F distribution with `above` and `below` degrees of
/// freedom exceeds `f`: the regularised incomplete beta function by its continued fraction
/// (Abramowitz, Stegun 1964, 26.5.8, 26.6.2). Relative error below 1e-9 while it is above 1e-300.
/// \pre above > 0, below > 0; 1 for f of 0 or less
double f_tail(double f, double above, double below);

}  // namespace bathyal
