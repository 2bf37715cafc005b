// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/arm/internal/quantisation_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bathyal::diagnosis {
namespace {

constexpr double kMinStep = 1e-5;  ///< [rad]; finer ones move tips less than can be measured
constexpr double kDigitTolerance =
    2e-8;  ///< [rad] rounding of a value's last digits, grown by Euclid's steps
constexpr double kWhole = 1e-2;      ///< largest distance of a multiple from a whole number
constexpr std::size_t kFewest = 20;  ///< different values: fewer may be on a grid by chance

/// Absolute values but 0, ascending, each once.
std::vector<double> sizes(const RowMatrix& q, const Arm& arm) {
  std::vector<bool> turns(static_cast<std::size_t>(arm.size()), false);
  for (const Joint& joint : arm.joints()) {
    if (joint.type == JointType::kRevolute) turns[joint.coordinate] = true;
  }
  std::vector<double> out;
  for (Index j = 0; j < q.cols(); ++j) {
    for (Index i = 0; turns[j] && i < q.rows(); ++i) {
      if (q(i, j) != 0.0) out.push_back(std::abs(q(i, j)));
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Euclid's algorithm on lengths that are known to `tolerance`.
double common_measure(double a, double b, double tolerance) {
  while (b > tolerance) {
    const double rest = a - std::floor(a / b) * b;
    a = b;
    b = b - rest < tolerance ? 0.0 : rest;
  }
  return a;
}

}  // namespace

double quantisation_step(const RowMatrix& q, const Arm& arm) {
  const std::vector<double> values = sizes(q, arm);
  if (values.size() < kFewest) return 0.0;
  double step = values.front();
  for (const double value : values) {
    step = common_measure(value, step, kDigitTolerance);
    if (step < kMinStep) return 0.0;
  }
  // The smallest value gives the step with its own rounding: larger ones are more precise.
  for (const double value : values) {
    const double multiple = std::round(value / step);
    if (std::abs(value / step - multiple) > 0.1) return 0.0;
    step = value / multiple;
  }
  for (const double value : values) {
    if (std::abs(value / step - std::round(value / step)) > kWhole) return 0.0;
  }
  return step;
}

}  // namespace bathyal::diagnosis
