// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace bathyal::arm {

template <class V>
struct SineCosine {
  typename V::D sine;
  typename V::D cosine;
};

/// Sine and cosine of every lane, within 1.5 ulp up to |x| = 1e5 and by the C library beyond; the
/// same operations, and so the same bytes, in vectors of any width. Finite x only.
///
/// The nearest multiple of pi/2 is taken off in three parts (Cody, Waite 1980): 33 bits each, so
/// that multiples below 2^20 are exact. The polynomials are Chebyshev interpolants on
/// |r| <= pi/4, of relative error below 2^-56.
template <class V>
inline SineCosine<V> sincos(typename V::D x) {
  using D = typename V::D;
  using I = typename V::I;
  constexpr double kReduced = 1e5;
  constexpr double kRound = 0x1.8p+52;  // adding it rounds to a whole number, its low bits
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPi[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};

  const D rounded = x * kTwoOverPi + kRound;
  const D quarters = rounded - kRound;
  const I quadrant = reinterpret_cast<I>(rounded);
  const D high = x - quarters * kHalfPi[0];  // exact, as is the product below
  const D middle = quarters * kHalfPi[1];
  const D difference = high - middle;
  const D lost = (high - difference) - middle;
  const D r = difference + (lost - quarters * kHalfPi[2]);

  const D z = r * r;
  const D sine_tail = -0x1.5555555555555p-3 +
                      z * (0x1.1111111110bb1p-7 +
                           z * (-0x1.a01a019e8357dp-13 +
                                z * (0x1.71de37961e4c6p-19 +
                                     z * (-0x1.ae600a926c89ap-26 + z * 0x1.5e0af186af739p-33))));
  const D cosine_tail = 0x1.5555555555555p-5 +
                        z * (-0x1.6c16c16c16966p-10 +
                             z * (0x1.a01a019f4e867p-16 +
                                  z * (-0x1.27e4fa17a41b4p-22 +
                                       z * (0x1.1eeb68b109173p-29 - z * 0x1.907d7aebd5e3dp-37))));
  const D half = z * 0.5;
  const D most = 1.0 - half;
  const D sine = r + r * (z * sine_tail);
  const D cosine = most + (((1.0 - most) - half) + z * (z * cosine_tail));

  const I swapped = (quadrant & 1) != 0;
  const I sine_sign = (quadrant & 2) << 62;
  const I cosine_sign = ((quadrant + 1) & 2) << 62;
  const I sine_bits = swapped ? reinterpret_cast<I>(cosine) : reinterpret_cast<I>(sine);
  const I cosine_bits = swapped ? reinterpret_cast<I>(sine) : reinterpret_cast<I>(cosine);
  SineCosine<V> result{reinterpret_cast<D>(sine_bits ^ sine_sign),
                       reinterpret_cast<D>(cosine_bits ^ cosine_sign)};

  for (int lane = 0; lane < V::kLanes; ++lane) {
    if (__builtin_expect(x[lane] > kReduced || x[lane] < -kReduced, 0)) {
      result.sine[lane] = __builtin_sin(x[lane]);
      result.cosine[lane] = __builtin_cos(x[lane]);
    }
  }
  return result;
}

}  // namespace bathyal::arm
