// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal {

/// Probability that a variable of Fisher's F distribution with `above` and `below` degrees of
/// freedom exceeds `f`: the regularised incomplete beta function by its continued fraction
/// (Abramowitz, Stegun 1964, 26.5.8, 26.6.2). Relative error below 1e-9 while it is above 1e-300.
/// \pre above > 0, below > 0; 1 for f of 0 or less
double f_tail(double f, double above, double below);

/// Fisher's F test of columns in a regression.
struct FTest {
  double p = 1.0;
  double explained =
      0.0;             ///< sum of squares beyond what chance gives to as many columns; 0 or more
  double share = 0.0;  ///< of all squares; 0 … 1
};

/// `width` columns explain `explained` of the sum of squares `total`, of `dof` degrees of freedom.
/// \pre dof > width > 0; p of 1 where nothing is left for the noise
FTest f_test(double explained, double width, double total, double dof);

}  // namespace bathyal
