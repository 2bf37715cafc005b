// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/random.hpp"
#include "bathyal/world/survey/survey.hpp"

namespace bathyal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Each part of the scene draws from a stream of its own: more boulders leave the waves alone.
enum Stream : std::uint64_t { kUndulation = 1, kMeander, kBoulders, kTrench };

double square(double v) { return v * v; }

/// 0 below 0, 1 above 1, smooth between.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

GeneratedSeabed::GeneratedSeabed(const SurveyOptions& options)
    : x0_(options.origin.x()),
      y0_(options.origin.y()),
      z0_(options.origin.z()),
      wave_height_(options.wave_height),
      wave_number_(kTurn / options.wave_length),
      ripple_height_(options.ripple_height),
      trench_depth_(options.trench_depth),
      trench_half_(0.5 * options.trench_width) {
  // Long undulation: waves of random direction whose height grows with their length.
  RandomStream random(options.seed, kUndulation);
  const double extent = std::max(options.length, options.width);
  double power = 0.0;
  for (int i = 0; i < 7; ++i) {
    const double length = extent * std::pow(0.72, i);
    const double direction = random.uniform(0.0, kTurn);
    const double k = kTurn / length;
    undulation_.push_back({k * std::cos(direction), k * std::sin(direction),
                           random.uniform(0.0, kTurn), length / extent});
    power += 0.5 * square(length / extent);
  }
  for (Wave& wave : undulation_) wave.amplitude *= options.roughness / std::sqrt(power);

  // Crests of the sand waves meander by a good part of their length.
  random = RandomStream(options.seed, kMeander);
  for (int i = 0; i < 3; ++i) {
    const double k = kTurn / (options.wave_length * random.uniform(1.8, 4.5));
    meander_.push_back({0.25 * k, k, random.uniform(0.0, kTurn), random.uniform(0.3, 0.7)});
  }

  random = RandomStream(options.seed, kTrench);
  trench_x_ = options.length * random.uniform(0.62, 0.7);
  trench_phase_ = random.uniform(0.0, kTurn);

  random = RandomStream(options.seed, kBoulders);
  double tallest = 0.0;
  for (int i = 0; i < options.boulders; ++i) {
    // Few are large: radii fall off as a power law down to a fifth of the largest.
    const double radius = options.boulder_radius * std::max(0.2, std::pow(random.uniform(), 1.6));
    const double turn = random.uniform(0.0, kTurn);
    Boulder boulder{};
    boulder.x = random.uniform(0.0, options.length);
    boulder.y = random.uniform(0.0, options.width);
    boulder.along = radius * random.uniform(1.0, 1.4);
    boulder.across = radius * random.uniform(0.7, 1.0);
    boulder.cosine = std::cos(turn);
    boulder.sine = std::sin(turn);
    boulder.height = radius * random.uniform(0.5, 0.9);
    tallest += boulder.height;  // should all of them lie on one heap
    boulders_.push_back(boulder);
  }
  highest_ = 0.5 * (wave_height_ + ripple_height_) + tallest;
  for (const Wave& wave : undulation_) highest_ += wave.amplitude;
}

double GeneratedSeabed::local_height(double x, double y) const {
  double height = sand_wave(x, y) + trench(x, y) + boulders(x, y);
  for (const Wave& wave : undulation_) {
    height += wave.amplitude * std::sin(wave.kx * x + wave.ky * y + wave.phase);
  }
  return height;
}

/// The current runs along x: sin(φ + 0.45 sin φ) leans the crest over and makes the lee side steep.
double GeneratedSeabed::sand_wave(double x, double y) const {
  double phase = wave_number_ * (x + 0.12 * y);
  for (const Wave& wave : meander_) {
    phase += wave.amplitude * std::sin(wave.kx * x + wave.ky * y + wave.phase);
  }
  const double lean = phase + 0.45 * std::sin(phase);
  // Ripples ride on the waves, thirteen to one, and are highest on the stoss side.
  const double stoss = 0.6 + 0.4 * std::cos(phase);
  return 0.5 * wave_height_ * std::sin(lean) +
         0.5 * ripple_height_ * stoss * std::sin(13.0 * phase + 1.7 * std::sin(0.9 * y));
}

double GeneratedSeabed::trench(double x, double y) const {
  const double middle = trench_x_ + 0.08 * y + 0.6 * std::sin(0.21 * y + trench_phase_);
  const double off = std::abs(x - middle) / trench_half_;
  if (off >= 1.0) return 0.0;
  // Walls over the outer half, a floor that is nearly flat between.
  return -trench_depth_ * smooth_step(2.0 * (1.0 - off)) * (1.0 - 0.08 * square(off));
}

double GeneratedSeabed::boulders(double x, double y) const {
  double height = 0.0;
  for (const Boulder& boulder : boulders_) {
    const double dx = x - boulder.x;
    const double dy = y - boulder.y;
    const double reach = 2.2 * boulder.along;
    if (dx * dx + dy * dy >= reach * reach) continue;
    const double u = (boulder.cosine * dx + boulder.sine * dy) / boulder.along;
    const double v = (boulder.cosine * dy - boulder.sine * dx) / boulder.across;
    const double q = std::sqrt(u * u + v * v);
    if (q < 1.0) {
      const double dome = std::sqrt(1.0 - q * q);
      height += boulder.height * dome * std::sqrt(dome);
    }
    // The current has carried sand away around it.
    height -= 0.18 * boulder.height * smooth_step(1.0 - std::abs(q - 1.1) / 0.9);
  }
  return height;
}

}  // namespace bathyal
