// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/pattern_mean.hpp"

#include <array>
#include <cmath>

#include "bathyal/sonar/internal/beam_pattern.hpp"

namespace bathyal::sonar {
namespace {

constexpr double kEndOfTable = 32.0;    ///< of the table; beyond it the pattern itself
constexpr double kRowsOfPlace = 128.0;  ///< of the table in one half-power place
constexpr double kNarrowCell = 1e-3;    ///< half of a cell over which there is nothing to average
constexpr double kRowStep = 1.0 / kRowsOfPlace;

}  // namespace

PatternMean::PatternMean(BeamPattern kind, bool squared) : kind_(kind), squared_(squared) {
  const auto rows = static_cast<std::size_t>(kEndOfTable * kRowsOfPlace);
  powers_.push_back(power(0.0));
  integrals_.push_back(0.0);
  for (std::size_t row = 0; row < rows; ++row) {  // Simpson's rule
    const double low = static_cast<double>(row) * kRowStep;
    powers_.push_back(power(low + kRowStep));
    const double sum = powers_[row] + 4.0 * power(low + 0.5 * kRowStep) + powers_[row + 1];
    integrals_.push_back(integrals_[row] + kRowStep / 6.0 * sum);
  }
}

double PatternMean::power(double off) const {
  const double once = pattern_shape(kind_, off);
  return squared_ ? once * once : once;
}

/// Between rows linear, to 10⁻⁵ of the axis.
double PatternMean::at(double off) const {
  const double place = std::abs(off) * kRowsOfPlace;
  const auto row = static_cast<std::size_t>(place);
  return powers_[row] + (place - static_cast<double>(row)) * (powers_[row + 1] - powers_[row]);
}

/// Between rows by the cubic that has the pattern as its slope.
double PatternMean::integral(double off) const {
  const double place = std::abs(off) * kRowsOfPlace;
  const auto row = static_cast<std::size_t>(place);
  const double t = place - static_cast<double>(row);
  const double low = integrals_[row], rise = integrals_[row + 1] - low;
  const double first = kRowStep * powers_[row], last = kRowStep * powers_[row + 1];
  const double along =
      low + t * (first + t * (3.0 * rise - 2.0 * first - last + t * (first + last - 2.0 * rise)));
  return std::copysign(along, off);
}

double PatternMean::operator()(double off, double half) const {
  if (std::abs(off) + half >= kEndOfTable) return power(off);
  if (half < kNarrowCell) return at(off);
  return (integral(off + half) - integral(off - half)) / (2.0 * half);
}

const PatternMean& pattern_mean(BeamPattern kind, bool squared) {
  using enum BeamPattern;
  static const std::array<std::array<PatternMean, 2>, 5> all = [] {
    const auto both = [](BeamPattern of) {
      return std::array{PatternMean(of, false), PatternMean(of, true)};
    };
    return std::array{both(kNone), both(kUniform), both(kHann), both(kTaylor), both(kGaussian)};
  }();
  return all[static_cast<std::size_t>(kind)][squared ? 1 : 0];
}

}  // namespace bathyal::sonar
