// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/water/sound_path.hpp"

namespace bathyal {
namespace {

/// How far below the point a ray of a launch angle passes, and how it is there.
struct Passage {
  double launch = 0.0;
  bool reaches = false;  ///< the distance, in the water
  double below = 0.0;    ///< [m]
  SoundState state;
};

class Fan {
 public:
  Fan(const SpeedProfile& profile, double from, double to, double distance, bool reflects)
      : profile_(profile), from_(from), to_(to) {
    const double slowest = *std::min_element(profile.speed().begin(), profile.speed().end());
    options_.surface_reflects = reflects;
    options_.max_distance = distance;
    // No ray within the fan takes longer: its way is at most distance / cos θ, θ at its steepest.
    options_.max_time = 1e3 * (distance + std::abs(to - from)) / slowest + 1.0;
  }

  Passage pass(double launch) const {
    const SoundPath path(profile_, from_, launch, options_);
    Passage passage;
    passage.launch = launch;
    passage.reaches = path.end() == SoundPathEnd::kDistance;
    passage.state = path.nodes().back();
    passage.below = passage.state.depth - to_;
    return passage;
  }

  /// Between two launches that pass on different sides; empty where they do so by a jump.
  bool bisect(Passage a, Passage b, Eigenray& ray) const {
    for (int step = 0; step < 200 && a.below != 0.0; ++step) {
      const double middle = 0.5 * (a.launch + b.launch);
      if (middle == a.launch || middle == b.launch) break;
      const Passage m = pass(middle);
      if (!m.reaches) return false;
      ((m.below < 0.0) == (a.below < 0.0) ? a : b) = m;
    }
    const Passage& best = std::abs(a.below) <= std::abs(b.below) ? a : b;
    if (std::abs(best.below) > 1e-3) return false;
    ray = {.launch = best.launch,
           .arrival = std::atan2(best.state.down, best.state.along),
           .time = best.state.time};
    return true;
  }

 private:
  const SpeedProfile& profile_;
  double from_;
  double to_;
  SoundPathOptions options_;
};

std::vector<double> launches(double straight, const EigenrayOptions& options) {
  const double half = 0.5 * std::numbers::pi;
  const double steepest =
      std::min(std::max(options.steepest, 0.5 * (std::abs(straight) + half)), half * (1.0 - 1e-9));
  std::vector<double> angles;
  for (int i = 0; i <= options.angles; ++i) {
    angles.push_back(steepest * (2.0 * i / options.angles - 1.0));
  }
  angles.push_back(straight);
  std::sort(angles.begin(), angles.end());
  return angles;
}

}  // namespace

void EigenrayOptions::check() const {
  check_range("angles", angles, 10, 1000000);
  check_range("steepest", steepest, 0.01, 1.57);
}

std::vector<Eigenray> eigenrays(const SpeedProfile& profile, double from_depth, double to_depth,
                                double distance, const EigenrayOptions& options) {
  options.check();
  check_not_negative("from_depth", from_depth);
  check_not_negative("to_depth", to_depth);
  check_not_negative("distance", distance);
  const double drop = to_depth - from_depth;
  if (distance == 0.0) {
    const double angle = std::copysign(0.5 * std::numbers::pi, drop);
    if (drop == 0.0) return {{}};
    double time = 0.0;  // straight down or up, through every layer
    SoundPathOptions vertical;
    vertical.max_time = 1e6;  // [s]
    const SoundPath path(profile, std::min(from_depth, to_depth), 0.5 * std::numbers::pi, vertical);
    const double deep = std::max(from_depth, to_depth);
    for (std::size_t i = 0; i + 1 < path.nodes().size(); ++i) {
      const SoundState& a = path.nodes()[i];
      const SoundState& b = path.nodes()[i + 1];
      if (b.depth < deep) continue;
      const double way = deep - a.depth;
      const double growth = path.gradient(i) * way / a.speed;
      time = a.time + way / a.speed * (growth == 0.0 ? 1.0 : std::log1p(growth) / growth);
      break;
    }
    return {{.launch = angle, .arrival = angle, .time = time}};
  }
  const Fan fan(profile, from_depth, to_depth, distance, options.surface_reflects);
  std::vector<Eigenray> rays;
  Passage last;
  for (const double launch : launches(std::atan2(drop, distance), options)) {
    const Passage now = fan.pass(launch);
    Eigenray ray;
    if (now.reaches && now.below == 0.0) {
      rays.push_back({.launch = launch,
                      .arrival = std::atan2(now.state.down, now.state.along),
                      .time = now.state.time});
    } else if (now.reaches && last.reaches && last.below != 0.0 &&
               (now.below < 0.0) != (last.below < 0.0) && fan.bisect(last, now, ray)) {
      rays.push_back(ray);
    }
    last = now;
  }
  std::sort(rays.begin(), rays.end(),
            [](const Eigenray& a, const Eigenray& b) { return a.time < b.time; });
  return rays;
}

}  // namespace bathyal
