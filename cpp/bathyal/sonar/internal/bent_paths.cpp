// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/bent_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/parallel.hpp"
#include "bathyal/water/sound_path.hpp"

namespace bathyal::sonar {
namespace {

constexpr double kStep = std::numbers::pi / 512.0;  ///< between rows [rad], at most
constexpr double kVertical = 0.5 * std::numbers::pi;
constexpr double kFarthest = 0.02;  ///< of a chord from its arc [m]
constexpr int kMostChords = 64;
constexpr int kLeastSteps = 32;
constexpr double kTightest = 0.1;  ///< of a tube of rays; there a caustic is near

double off_chord(const SoundState& a, const SoundState& b, const SoundState& between) {
  const double out = b.distance - a.distance, down = b.depth - a.depth;
  const double cross = out * (between.depth - a.depth) - down * (between.distance - a.distance);
  return std::abs(cross) / std::max(std::hypot(out, down), 1e-12);
}

/// Within 2·10⁻⁸ (Abramowitz, Stegun 1964, 4.4.46).
double fast_asin(double x) {
  const double a = std::abs(x);
  const double sum =
      1.5707963050 +
      a * (-0.2145988016 +
           a * (0.0889789874 +
                a * (-0.0501743046 +
                     a * (0.0308918810 +
                          a * (-0.0170881256 + a * (0.0066700901 + a * -0.0012624911))))));
  return std::copysign(kVertical - std::sqrt(1.0 - a) * sum, x);
}

}  // namespace

BentPaths::BentPaths(const SpeedProfile& profile, double depth, double range, double steepest_up,
                     double steepest_down, int num_threads)
    : profile_(profile), range_(1.02 * range), speed_(profile.speed(depth)) {
  low_ = std::max(std::min(steepest_up, steepest_down - 4.0 * kStep), -kVertical);
  const double high = std::min(std::max(steepest_down, low_ + 4.0 * kStep), kVertical);
  rows_ = static_cast<std::size_t>(std::ceil((high - low_) / kStep)) + 1;
  apart_ = (high - low_) / static_cast<double>(rows_ - 1);
  int chords = 1;
  while (chords < kMostChords && !close_enough(depth, chords)) chords *= 2;
  steps_ = static_cast<std::size_t>(std::max(kLeastSteps, 4 * chords));
  points_.resize(rows_ * (steps_ + 1));
  fill(depth, num_threads);
  fill_tubes();
  fill_chords();
}

double BentPaths::angle_of(std::size_t row) const {
  return std::clamp(low_ + static_cast<double>(row) * apart_, -kVertical, kVertical);
}

SoundPath BentPaths::path_of(double depth, std::size_t row) const {
  SoundPathOptions options;
  options.max_time = range_ / speed_;
  options.surface = false;
  return SoundPath(profile_, depth, angle_of(row), options);
}

bool BentPaths::close_enough(double depth, int chords) const {
  const double time = range_ / speed_;
  const double step = time / chords;
  for (std::size_t row = 0; row < rows_; row += 4) {
    const SoundPath path = path_of(depth, row);
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
  parallel_for(rows_, 16, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double angle = angle_of(row);
      const SoundPath path = path_of(depth, row);
      for (std::size_t step = 0; step <= steps_; ++step) {
        const double part = static_cast<double>(step) / static_cast<double>(steps_);
        const SoundState state = path.at(part * time);
        Point& point = points_[row * (steps_ + 1) + step];
        point.out = state.distance - part * range_ * std::cos(angle);
        point.down = state.depth - depth - part * range_ * std::sin(angle);
        point.state = {step == 0 ? 0.0 : std::atan2(state.down, state.along) - angle, state.speed,
                       1.0};
      }
    }
  });
}

/// A tube's area is that of the ring that its rays turn through about the vertical, times how far
/// rays part that leave in directions one above the other.
void BentPaths::fill_tubes() {
  const auto tube = [&](std::size_t row, std::size_t step) -> double& {
    return points_[row * (steps_ + 1) + step].state.tube;
  };
  for (std::size_t step = 1; step <= steps_; ++step) {
    const double range = step_range() * static_cast<double>(step);
    for (std::size_t row = 1; row + 1 < rows_; ++row) {
      const double angle = angle_of(row);
      const Point& below = at(row - 1, step);
      const Point& above = at(row + 1, step);
      const double out = (above.out - below.out) / (2.0 * apart_) - range * std::sin(angle);
      const double down = (above.down - below.down) / (2.0 * apart_) + range * std::cos(angle);
      const double ring = 1.0 + at(row, step).out / (range * std::cos(angle));
      tube(row, step) =
          std::clamp(ring * std::hypot(out, down) / range, kTightest, 1.0 / kTightest);
    }
    tube(0, step) = tube(1, step);
    tube(rows_ - 1, step) = tube(rows_ - 2, step);
  }
}

/// Whether a row's places between two steps lie near the chord, by some of them.
bool BentPaths::near_chord(std::size_t row, std::size_t first, std::size_t end) const {
  const double angle = angle_of(row);
  const auto place_of = [&](std::size_t step) {
    const double range = step_range() * static_cast<double>(step);
    SoundState state;
    state.distance = at(row, step).out + range * std::cos(angle);
    state.depth = at(row, step).down + range * std::sin(angle);
    return state;
  };
  const SoundState from = place_of(first), to = place_of(end);
  constexpr std::size_t kPlaces = 16;
  const std::size_t apart = std::max<std::size_t>(1, (end - first) / kPlaces);
  for (std::size_t step = first + apart; step < end; step += apart) {
    if (off_chord(from, to, place_of(step)) > kFarthest) return false;
  }
  return true;
}

/// From the launch on, of the rest the longest of the whole, its half, its quarter … that
/// stays near both rows, between which rays lie.
void BentPaths::fill_chords() {
  ends_.resize(rows_ - 1);
  for (std::size_t row = 0; row + 1 < rows_; ++row) {
    for (std::size_t first = 0; first < steps_;) {
      std::size_t count = steps_ - first;
      while (count > 1 && !(near_chord(row, first, first + count) &&
                            near_chord(row + 1, first, first + count))) {
        count = (count + 1) / 2;
      }
      first += count;
      ends_[row].push_back(static_cast<int>(first));
    }
  }
}

BentPaths::Launch BentPaths::launch(const Vec3& direction) const {
  Launch launch;
  launch.down = std::clamp(-direction.z(), -1.0, 1.0);
  launch.along = std::sqrt(direction.x() * direction.x() + direction.y() * direction.y());
  if (launch.along > 1e-12) launch.level = Vec3(direction.x(), direction.y(), 0.0) / launch.along;
  const double angle = fast_asin(launch.down);
  const double place = std::clamp((angle - low_) / apart_, 0.0, static_cast<double>(rows_ - 1));
  launch.row = std::min(static_cast<std::size_t>(place), rows_ - 2);
  launch.part = place - static_cast<double>(launch.row);
  return launch;
}

Vec3 BentPaths::place(const Launch& launch, int steps) const {
  const Point& low = at(launch.row, static_cast<std::size_t>(steps));
  const Point& high = at(launch.row + 1, static_cast<std::size_t>(steps));
  const double straight = step_range() * steps;
  const double out = straight * launch.along + low.out + launch.part * (high.out - low.out);
  const double down = straight * launch.down + low.down + launch.part * (high.down - low.down);
  return out * launch.level - Vec3(0.0, 0.0, down);
}

BentPaths::State BentPaths::state(const Launch& launch, int steps) const {
  const State& low = at(launch.row, static_cast<std::size_t>(steps)).state;
  const State& high = at(launch.row + 1, static_cast<std::size_t>(steps)).state;
  const auto between = [&](double a, double b) { return a + launch.part * (b - a); };
  return {between(low.turned, high.turned), between(low.speed, high.speed),
          between(low.tube, high.tube)};
}

Vec3 BentPaths::turned(const Launch& launch, double angle) {
  const double square = angle * angle;
  const bool small = square < 0.01;  // to 10⁻⁹
  const double cosine = small ? 1.0 - square * (0.5 - square / 24.0) : std::cos(angle);
  const double sine =
      small ? angle * (1.0 - square * (1.0 / 6.0 - square / 120.0)) : std::sin(angle);
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
