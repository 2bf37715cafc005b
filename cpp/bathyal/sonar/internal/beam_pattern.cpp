// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/beam_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bathyal::sonar {
namespace {

constexpr double kHalfPower = 1.3915573782515103;  ///< sinc²(x) = 1/2
constexpr double kWidths = 2.6;                    ///< past the second side lobe of sinc²

}  // namespace

double pattern(BeamPattern kind, double angle, double width, double steered) {
  const double off = (std::sin(angle + steered) - std::sin(steered)) / std::sin(0.5 * width);
  switch (kind) {
    case BeamPattern::kNone:
      return 1.0;
    case BeamPattern::kUniform: {
      const double x = kHalfPower * off;
      if (std::abs(x) < 1e-8) return 1.0;
      const double sinc = std::sin(x) / x;
      return sinc * sinc;
    }
    case BeamPattern::kGaussian:
      return std::exp(-std::numbers::ln2 * off * off);
  }
  return 1.0;
}

double reach_of(BeamPattern kind, double width) {
  if (kind == BeamPattern::kNone) return 0.5 * width;
  return std::min(kWidths * width, 0.5 * std::numbers::pi);
}

}  // namespace bathyal::sonar
