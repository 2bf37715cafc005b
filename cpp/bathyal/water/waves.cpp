// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/waves.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr double kGravity = 9.80665;
constexpr double kLowest = 0.5;   // of the peak's frequency
constexpr double kHighest = 4.0;  // above lies 0.2 % of the energy at γ = 1

void check_depth_below(double depth) {
  if (!(depth > 0.0)) throw_argument("depth", "a depth above 0 m", to_text(depth));
}

/// JONSWAP's density at ω, but for a factor.
double spectrum(double frequency, double peak, double enhancement) {
  const double width = frequency <= peak ? 0.07 : 0.09;
  const double off = (frequency - peak) / (width * peak);
  return std::pow(frequency, -5.0) * std::exp(-1.25 * std::pow(peak / frequency, 4.0)) *
         std::pow(enhancement, std::exp(-0.5 * off * off));
}

/// An angle of density cos²ˢ(½Δ), −π to π, by rejection.
double draw_spread(double spreading, RandomStream& random) {
  if (std::isinf(spreading)) return 0.0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    if (random.uniform() < std::pow(std::cos(0.5 * angle), 2.0 * spreading)) return angle;
  }
  return 0.0;  // not reached: of s = 1 000 one trial in 56 is taken
}

/// cosh(k (z + h)) / sinh(k h) and sinh(k (z + h)) / sinh(k h), h possibly infinite.
struct Decay {
  double horizontal;
  double vertical;
};

Decay decay_at(double k, double z, double depth) {
  const double down = std::exp(k * z);
  if (k * depth > 350.0) return {down, down};
  const double mirror = std::exp(-k * (z + 2.0 * depth));
  const double base = 1.0 - std::exp(-2.0 * k * depth);
  return {(down + mirror) / base, (down - mirror) / base};
}

}  // namespace

void SeaState::check() const {
  check_not_negative("height", height);
  check_range("period", period, 0.5, 60.0);
  check_range("peak_enhancement", peak_enhancement, 1.0, 20.0);
  check_finite("direction", direction);
  if (!(spreading >= 0.0 && (spreading <= 1000.0 || std::isinf(spreading)))) {
    throw_argument("spreading", "a number from 0 to 1000, or infinite", to_text(spreading));
  }
  check_range("components", components, 1, 10000);
  check_depth_below(depth);
}

double wave_number(double frequency, double depth) {
  const double deep = frequency * frequency / kGravity;
  if (deep * depth > 350.0) return deep;
  // Newton's method on k tanh(k h) − ω²/g from Eckart's value, which is within 5 %.
  double k = deep / std::sqrt(std::tanh(deep * depth));
  for (int step = 0; step < 8; ++step) {
    const double t = std::tanh(k * depth);
    k -= (k * t - deep) / (t + k * depth * (1.0 - t * t));
  }
  return k;
}

Waves::Waves(const SeaState& sea) : depth_(sea.depth) {
  sea.check();
  if (sea.height == 0.0) return;
  const double peak = 2.0 * std::numbers::pi / sea.period;
  const double band = (kHighest - kLowest) * peak / sea.components;
  double variance = 0.0;
  for (int i = 0; i < sea.components; ++i) {
    RandomStream random(sea.seed, static_cast<std::uint64_t>(i));
    const double frequency =
        sea.components == 1 ? peak : kLowest * peak + (i + random.uniform()) * band;
    const double density = spectrum(frequency, peak, sea.peak_enhancement);
    const double heading = sea.direction + draw_spread(sea.spreading, random);
    const double k = wave_number(frequency, sea.depth);
    components_.push_back({.amplitude = std::sqrt(density),
                           .frequency = frequency,
                           .number = {k * std::cos(heading), k * std::sin(heading)},
                           .phase = random.uniform(0.0, 2.0 * std::numbers::pi)});
    variance += 0.5 * density;
  }
  const double scale = 0.25 * sea.height / std::sqrt(variance);
  for (WaveComponent& c : components_) c.amplitude *= scale;
}

Waves Waves::regular(double height, double period, double direction, double depth, double phase) {
  check_not_negative("height", height);
  check_range("period", period, 0.5, 60.0);
  check_finite("direction", direction);
  check_depth_below(depth);
  check_finite("phase", phase);
  Waves waves;
  waves.depth_ = depth;
  const double frequency = 2.0 * std::numbers::pi / period;
  const double k = wave_number(frequency, depth);
  waves.components_.push_back({.amplitude = 0.5 * height,
                               .frequency = frequency,
                               .number = {k * std::cos(direction), k * std::sin(direction)},
                               .phase = phase});
  return waves;
}

Waves Waves::of(std::vector<WaveComponent> components, double depth) {
  check_depth_below(depth);
  for (const WaveComponent& c : components) {
    check_not_negative("amplitude", c.amplitude);
    check_positive("frequency", c.frequency);
    check_positive("number", c.number.norm());
    check_finite("phase", c.phase);
  }
  Waves waves;
  waves.components_ = std::move(components);
  waves.depth_ = depth;
  return waves;
}

double Waves::elevation(double x, double y, double time) const {
  double sum = 0.0;
  for (const WaveComponent& c : components_) {
    sum +=
        c.amplitude * std::cos(c.number.x() * x + c.number.y() * y - c.frequency * time + c.phase);
  }
  return sum;
}

double Waves::elevation_rate(double x, double y, double time) const {
  double sum = 0.0;
  for (const WaveComponent& c : components_) {
    sum += c.amplitude * c.frequency *
           std::sin(c.number.x() * x + c.number.y() * y - c.frequency * time + c.phase);
  }
  return sum;
}

Waves::Motion Waves::motion(const Vec3& point, double time) const {
  Motion motion;
  if (flat()) return motion;
  const double surface = elevation(point.x(), point.y(), time);
  if (!(point.z() <= surface) || !(point.z() >= -depth_)) return motion;
  // Wheeler: z' = h (z − η) / (h + η), from 0 at the surface to −h at the bottom; it moves with η.
  const bool deep = std::isinf(depth_);
  const double column = depth_ + surface;
  const double z = deep ? point.z() - surface : depth_ * (point.z() - surface) / column;
  const double z_rate = -elevation_rate(point.x(), point.y(), time) *
                        (deep ? 1.0 : depth_ * (depth_ + point.z()) / (column * column));
  for (const WaveComponent& c : components_) {
    const double k = c.number.norm();
    const Decay decay = decay_at(k, z, depth_);
    const double angle =
        c.number.x() * point.x() + c.number.y() * point.y() - c.frequency * time + c.phase;
    const double speed = c.amplitude * c.frequency;
    const Eigen::Vector2d along = c.number / k;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    motion.velocity.head<2>() += speed * decay.horizontal * cosine * along;
    motion.velocity.z() += speed * decay.vertical * sine;
    motion.acceleration.head<2>() +=
        speed * (c.frequency * decay.horizontal * sine + k * decay.vertical * z_rate * cosine) *
        along;
    motion.acceleration.z() +=
        speed * (-c.frequency * decay.vertical * cosine + k * decay.horizontal * z_rate * sine);
  }
  return motion;
}

}  // namespace bathyal
