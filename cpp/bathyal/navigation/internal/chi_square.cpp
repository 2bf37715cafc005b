// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/internal/chi_square.hpp"

#include <cmath>
#include <numbers>

namespace bathyal {

double chi_square_tail(double value, int count) {
  const double half = 0.5 * value;
  const bool even = count % 2 == 0;
  double tail = even ? std::exp(-half) : std::erfc(std::sqrt(half));
  // Q(k + 2) = Q(k) + half^(k/2) e^(−half) / Γ(k/2 + 1)
  double term =
      even ? half * std::exp(-half) : 2.0 * std::sqrt(half / std::numbers::pi) * std::exp(-half);
  for (int k = even ? 2 : 1; k < count; k += 2) {
    tail += term;
    term *= half / (0.5 * k + 1.0);
  }
  return tail;
}

}  // namespace bathyal
