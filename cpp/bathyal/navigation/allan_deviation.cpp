// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/navigation/allan_deviation.hpp"

#include <cmath>
#include <string>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

/// Integral of the data about its mean, which drops out of the second differences, in samples.
std::vector<double> integral_of(const std::vector<double>& data) {
  double mean = 0.0;
  for (const double value : data) mean += value / static_cast<double>(data.size());
  std::vector<double> sum{0.0};
  sum.reserve(data.size() + 1);
  for (const double value : data) sum.push_back(sum.back() + (value - mean));
  return sum;
}

double deviation_at(const std::vector<double>& integral, std::size_t m) {
  double squares = 0.0;
  const std::size_t terms = integral.size() - 2 * m;
  for (std::size_t k = 0; k < terms; ++k) {
    const double second = integral[k + 2 * m] - 2.0 * integral[k + m] + integral[k];
    squares += second * second;
  }
  return std::sqrt(squares / (2.0 * static_cast<double>(terms))) / static_cast<double>(m);
}

}  // namespace

AllanDeviation allan_deviation(const std::vector<double>& rate_data, double sample_rate,
                               std::vector<std::int64_t> factors) {
  const auto count = static_cast<std::int64_t>(rate_data.size());
  if (count < 4) throw_argument("rate_data", "4 samples or more", std::to_string(count));
  for (const double value : rate_data) check_finite("rate_data", value);
  check_positive("sample_rate", sample_rate);
  if (factors.empty()) {
    for (std::int64_t m = 1; m <= count / 4; m *= 2) factors.push_back(m);
  }
  const std::vector<double> integral = integral_of(rate_data);
  AllanDeviation result;
  for (const std::int64_t m : factors) {
    if (m < 1 || m > count / 2) {
      throw_argument("factors", "whole numbers from 1 to " + std::to_string(count / 2),
                     std::to_string(m));
    }
    result.interval.push_back(static_cast<double>(m) / sample_rate);
    result.deviation.push_back(deviation_at(integral, static_cast<std::size_t>(m)));
  }
  return result;
}

}  // namespace bathyal
