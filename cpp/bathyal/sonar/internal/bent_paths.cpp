// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/bent_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/parallel.hpp"
#include "bathyal/water/sound_path.hpp"

namespace bathyal::sonar {
namespace {

constexpr std::size_t kRows = 513;
constexpr double kFarthest = 0.02;  ///< of a chord from its arc [m]
constexpr int kMostChords = 64;
constexpr double kTightest = 0.1;  ///< of a tube of rays; there a caustic is near

double angle_of(std::size_t row) {
  if (row + 1 == kRows) return 0.5 * std::numbers::pi;
  return std::numbers::pi * (static_cast<double>(row) / (kRows - 1) - 0.5);
}

SoundPath path_of(const SpeedProfile& profile, double depth, std::size_t row, double time) {
  SoundPathOptions options;
  options.max_time = time;
  options.surface = false;
  return SoundPath(profile, depth, angle_of(row), options);
}

double off_chord(const SoundState& a, const SoundState& b, const SoundState& between) {
  const double out = b.distance - a.distance, down = b.depth - a.depth;
  const double cross = out * (between.depth - a.depth) - down * (between.distance - a.distance);
  return std::abs(cross) / std::max(std::hypot(out, down), 1e-12);
}

}  // namespace

BentPaths::BentPaths(const SpeedProfile& profile, double depth, double range, int num_threads)
    : profile_(profile), range_(1.02 * range), speed_(profile.speed(depth)) {
  while (chords_ < kMostChords && !close_enough(depth, chords_)) chords_ *= 2;
  chord_range_ = range_ / chords_;
  halves_ = static_cast<std::size_t>(2 * chords_ + 1);
  points_.resize(kRows * halves_);
  fill(depth, num_threads);
  fill_tubes();
}

bool BentPaths::close_enough(double depth, int chords) const {
  const double time = range_ / speed_;
  const double step = time / chords;
  for (std::size_t row = 0; row < kRows; row += 16) {
    const SoundPath path = path_of(profile_, depth, row, time);
    for (int k = 0; k < chords; ++k) {
      const SoundState a = path.at(step * k), b = path.at(step * (k + 1));
      for (const double part : {0.25, 0.5, 0.75}) {
        if (off_chord(a, b, path.at(step * (k + part))) > kFarthest) return false;
      }
    }
  }
  return true;
}

void BentPaths::fill(double depth, int num_threads) {
  const double time = range_ / speed_;
  parallel_for(kRows, 32, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double angle = angle_of(row);
      const SoundPath path = path_of(profile_, depth, row, time);
      for (std::size_t half = 0; half < halves_; ++half) {
        const double part = static_cast<double>(half) / static_cast<double>(halves_ - 1);
        const SoundState state = path.at(part * time);
        Point& point = points_[row * halves_ + half];
        point.out = state.distance - part * range_ * std::cos(angle);
        point.down = state.depth - depth - part * range_ * std::sin(angle);
        point.state = {half == 0 ? 0.0 : std::atan2(state.down, state.along) - angle, state.speed,
                       1.0};
      }
    }
  });
}

/// A tube's area is that of the ring that its rays turn through about the vertical, times how far
/// rays part that leave in directions one above the other.
void BentPaths::fill_tubes() {
  const double step = std::numbers::pi / (kRows - 1);
  for (std::size_t half = 1; half < halves_; ++half) {
    const double range = range_ * static_cast<double>(half) / static_cast<double>(halves_ - 1);
    for (std::size_t row = 1; row + 1 < kRows; ++row) {
      const double angle = angle_of(row);
      const Point& below = at(row - 1, half);
      const Point& above = at(row + 1, half);
      const double out = (above.out - below.out) / (2.0 * step) - range * std::sin(angle);
      const double down = (above.down - below.down) / (2.0 * step) + range * std::cos(angle);
      const double ring = 1.0 + at(row, half).out / (range * std::cos(angle));
      points_[row * halves_ + half].state.tube =
          std::clamp(ring * std::hypot(out, down) / range, kTightest, 1.0 / kTightest);
    }
    points_[half].state.tube = at(1, half).state.tube;
    points_[(kRows - 1) * halves_ + half].state.tube = at(kRows - 2, half).state.tube;
  }
}

BentPaths::Launch BentPaths::launch(const Vec3& direction) const {
  Launch launch;
  launch.down = std::clamp(-direction.z(), -1.0, 1.0);
  launch.along = std::hypot(direction.x(), direction.y());
  if (launch.along > 1e-12) launch.level = Vec3(direction.x(), direction.y(), 0.0) / launch.along;
  const double angle = std::atan2(launch.down, launch.along);
  const double place = std::clamp((angle / std::numbers::pi + 0.5) * (kRows - 1), 0.0, kRows - 1.0);
  launch.row = std::min(static_cast<std::size_t>(place), kRows - 2);
  launch.part = place - static_cast<double>(launch.row);
  return launch;
}

Vec3 BentPaths::place(const Launch& launch, double ends) const {
  const auto half = static_cast<std::size_t>(2.0 * ends);
  const Point& low = at(launch.row, half);
  const Point& high = at(launch.row + 1, half);
  const double straight = chord_range_ * ends;
  const double out = straight * launch.along + low.out + launch.part * (high.out - low.out);
  const double down = straight * launch.down + low.down + launch.part * (high.down - low.down);
  return out * launch.level - Vec3(0.0, 0.0, down);
}

BentPaths::State BentPaths::state(const Launch& launch, int ends) const {
  const auto half = static_cast<std::size_t>(2 * ends);
  const State& low = at(launch.row, half).state;
  const State& high = at(launch.row + 1, half).state;
  const auto between = [&](double a, double b) { return a + launch.part * (b - a); };
  return {between(low.turned, high.turned), between(low.speed, high.speed),
          between(low.tube, high.tube)};
}

Vec3 BentPaths::turned(const Launch& launch, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  return (launch.along * cosine - launch.down * sine) * launch.level -
         Vec3(0.0, 0.0, launch.down * cosine + launch.along * sine);
}

double BentPaths::slow_range(double length, double from_depth, double to_depth) const {
  const double slowness =  // Simpson's rule
      (1.0 / profile_.speed(from_depth) + 4.0 / profile_.speed(0.5 * (from_depth + to_depth)) +
       1.0 / profile_.speed(to_depth)) /
      6.0;
  return length * speed_ * slowness;
}

}  // namespace bathyal::sonar
