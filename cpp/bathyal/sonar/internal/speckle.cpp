// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/speckle.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::sonar {

/// The polar method (Marsaglia, Bray 1964): of a point in the unit disc, r² is uniform, so that
/// −ln r² is the power.
Phasor circular(RandomStream& random) {
  constexpr double kUnit = 0x1.0p-31;
  double x = 0.0, y = 0.0, square = 0.0;
  do {
    const std::uint64_t bits = random.next();
    x = kUnit * static_cast<double>(static_cast<std::int32_t>(bits >> 32U));
    y = kUnit * static_cast<double>(static_cast<std::int32_t>(bits & 0xffffffffU));
    square = x * x + y * y;
  } while (square >= 1.0 || square == 0.0);
  const double scale = std::sqrt(-std::log(square) / square);
  return {scale * x, scale * y};
}

double texture(RandomStream& random, double shape) {
  const double boosted = shape < 1.0 ? shape + 1.0 : shape;
  const double d = boosted - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  double value = 0.0;
  while (value == 0.0) {
    const double x = random.normal();
    const double cube_root = 1.0 + c * x;
    if (cube_root <= 0.0) continue;
    const double v = cube_root * cube_root * cube_root;
    if (std::log(1.0 - random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) value = d * v;
  }
  if (shape < 1.0) value *= std::pow(1.0 - random.uniform(), 1.0 / shape);
  return value / shape;
}

void draw_speckle(const ReceiverOptions& options, const double* power, std::uint64_t key,
                  Amplitudes& to) {
  for (std::size_t i = 0; i < to.real.size(); ++i) {
    if (!(power[i] > 0.0)) {
      to.real[i] = to.imaginary[i] = 0.0;
      continue;
    }
    RandomStream random(key, i);
    const Phasor drawn = circular(random);
    const double patch =
        options.speckle == SpeckleModel::kK ? texture(random, options.speckle_shape) : 1.0;
    const double size = std::sqrt(power[i] * patch);
    to.real[i] = size * drawn.real;
    to.imaginary[i] = size * drawn.imaginary;
  }
}

void convolve(const std::vector<double>& shape, std::ptrdiff_t first,
              const std::vector<double>& from, std::vector<double>& to) {
  const auto count = static_cast<std::ptrdiff_t>(from.size());
  to.assign(from.size(), 0.0);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const std::ptrdiff_t shift = first + static_cast<std::ptrdiff_t>(k);
    const std::ptrdiff_t begin = std::clamp<std::ptrdiff_t>(shift, 0, count);
    const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(count + shift, begin, count);
    const double weight = shape[k];
    const double* source = from.data();
    double* sum = to.data();
    for (std::ptrdiff_t i = begin; i < end; ++i) sum[i] += weight * source[i - shift];
  }
}

}  // namespace bathyal::sonar
