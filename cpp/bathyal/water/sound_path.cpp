// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/sound_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/water/internal/arc.hpp"

namespace bathyal {
namespace {

/// The layer that a ray on its way at a depth goes through, and its gradient. On a row it is the
/// one that the ray enters; of a horizontal ray the one it bends into, down where it may do either,
/// and where neither draws it away (the axis of a channel) it goes on along the row.
struct LayerAhead {
  std::size_t layer;
  double gradient;
};

LayerAhead layer_ahead(const SpeedProfile& profile, const SoundState& state) {
  const std::size_t below = profile.layer(state.depth);
  const double gradient = profile.gradient(below);
  if (below == 0 || state.depth > profile.top(below) || state.down > 0.0) return {below, gradient};
  const double above = profile.gradient(below - 1);
  if (state.down < 0.0) return {below - 1, above};
  if (gradient < 0.0) return {below, gradient};
  return above > 0.0 ? LayerAhead{below - 1, above} : LayerAhead{below, 0.0};
}

/// What a path meets first of its layer's bounds, and how it is there.
struct Crossing {
  double time = std::numeric_limits<double>::infinity();
  double depth = 0.0;
  double down = 0.0;
};

/// A ray that neither leaves the layer nor bends: horizontal, between rows of its own speed.
bool level(const SoundState& state, double gradient) {
  return state.down == 0.0 && gradient == 0.0;
}

Crossing next_crossing(const SoundState& state, double gradient, double top, double bottom) {
  Crossing next;
  if (level(state, gradient)) return next;
  const bool goes_down = state.down > 0.0 || (state.down == 0.0 && gradient < 0.0);
  const double ahead = goes_down ? bottom : top;
  const double behind = goes_down ? top : bottom;
  next.depth = ahead;
  if (const auto there = arc_to_depth(state, gradient, ahead)) {
    next.time = there->time;
    next.down = there->down;
    return next;
  }
  // It turns before: back through its own depth, and on to the other bound.
  SoundState mirrored = state;
  mirrored.down = -state.down;
  const double turn = std::abs(2.0 * std::asinh(state.down / state.along) / gradient);
  const auto back = arc_to_depth(mirrored, gradient, behind);
  if (!back) return {};  // both ways closed: a horizontal ray that rounding holds on its row
  next.time = turn + back->time;
  next.depth = behind;
  next.down = back->down;
  return next;
}

}  // namespace

SoundState advance(const SoundState& from, double gradient, double time) {
  // With u the inverse Gudermannian of the angle, u₂ = u₁ − g t; cos θ = 1 / cosh u.
  const double half = 0.5 * gradient * time;
  const double grown = time * sinh_ratio(half);  // 2 sinh(g t / 2) / g
  const double cosh_half = std::cosh(half);
  const double sinh_half = std::sinh(half);
  const double turned =
      std::cosh(2.0 * half) - from.down * std::sinh(2.0 * half);  // cos θ₁ / cos θ₂
  SoundState to;
  to.time = from.time + time;
  to.distance = from.distance + from.speed * grown * cosh_half * from.along / turned;
  to.depth = from.depth + from.speed * grown * (from.down * cosh_half - sinh_half) / turned;
  to.along = from.along / turned;
  to.down = (from.down * std::cosh(2.0 * half) - std::sinh(2.0 * half)) / turned;
  to.speed = from.speed / turned;
  return to;
}

void SoundPathOptions::check() const {
  check_positive("max_time", max_time);
  if (!(max_distance > 0.0)) {
    throw_argument("max_distance", "a number above 0", to_text(max_distance));
  }
}

SoundPath::SoundPath(const SpeedProfile& profile, double depth, double angle,
                     const SoundPathOptions& options) {
  options.check();
  check_finite("start_depth", depth);
  if (options.surface) check_not_negative("start_depth", depth);
  if (!(std::abs(angle) <= 0.5 * std::numbers::pi)) {
    throw_argument("launch_angle", "from −½π to ½π below the horizontal", to_text(angle) + " rad");
  }
  const bool vertical = std::abs(angle) == 0.5 * std::numbers::pi;
  nodes_.push_back({.depth = depth,
                    .along = vertical ? 0.0 : std::cos(angle),
                    .down = std::sin(angle),
                    .speed = profile.speed(depth)});

  while (true) {
    const SoundState& now = nodes_.back();
    if (nodes_.size() > options.max_arcs) {
      throw Error("the path of sound crosses more than " + std::to_string(options.max_arcs) +
                  " rows of its profile; raise max_arcs or shorten it");
    }
    if (options.surface && now.depth <= 0.0 && now.down < 0.0) {
      if (!options.surface_reflects) {
        end_ = SoundPathEnd::kSurface;
        return;
      }
      nodes_.back().down = -now.down;
    }
    const LayerAhead ahead = layer_ahead(profile, now);
    const std::size_t layer = ahead.layer;
    const double gradient = ahead.gradient;
    double top = profile.top(layer);
    if (options.surface) top = std::max(top, 0.0);
    const Crossing next = next_crossing(now, gradient, top, profile.bottom(layer));

    SoundState to;
    const double time_left = options.max_time - now.time;
    const bool crosses = next.time <= time_left;
    to = advance(now, gradient, crosses ? next.time : time_left);
    if (crosses) {  // on the row to the last bit, its speed and Snell's invariant as well
      to.depth = next.depth;
      to.speed = profile.speed(next.depth);
      to.along = std::min(nodes_.front().along / nodes_.front().speed * to.speed, 1.0);
      to.down = next.down;
    }
    if (to.distance >= options.max_distance) {
      arc_to(arc_to_distance(now, gradient, options.max_distance), gradient);
      end_ = SoundPathEnd::kDistance;
      return;
    }
    arc_to(to, gradient);
    if (!crosses) return;
  }
}

void SoundPath::arc_to(SoundState to, double gradient) {
  nodes_.push_back(to);
  gradient_.push_back(gradient);
}

SoundState SoundPath::at(double time) const {
  if (!(time > 0.0)) return nodes_.front();
  if (time >= duration()) return nodes_.back();
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), time,
                                      [](double t, const SoundState& n) { return t < n.time; });
  const auto arc = static_cast<std::size_t>(after - nodes_.begin()) - 1;
  return advance(nodes_[arc], gradient_[arc], time - nodes_[arc].time);
}

SoundState SoundPath::at_distance(double distance) const {
  if (!(distance > 0.0)) return nodes_.front();
  if (distance >= nodes_.back().distance) return nodes_.back();
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), distance,
                                      [](double d, const SoundState& n) { return d < n.distance; });
  const auto arc = static_cast<std::size_t>(after - nodes_.begin()) - 1;
  return arc_to_distance(nodes_[arc], gradient_[arc], distance);
}

std::vector<SoundState> SoundPath::chords(double tolerance) const {
  check_positive("tolerance", tolerance);
  std::vector<SoundState> points{nodes_.front()};
  for (std::size_t arc = 0; arc < gradient_.size(); ++arc) {
    const SoundState& from = nodes_[arc];
    const SoundState& to = nodes_[arc + 1];
    // Sagitta of a chord of length L on a circle of curvature κ: at most κ L² / 8, κ = g cos θ / c.
    const double curvature = std::abs(gradient_[arc]) * from.along / from.speed;
    const double fastest = std::max({from.speed, to.speed});
    const double length = fastest * (to.time - from.time) * 1.001;
    const double longest = std::sqrt(8.0 * tolerance / std::max(curvature, 1e-300));
    const double wanted = std::ceil(std::min(length / longest, 1e7));
    const int parts = std::max(1, static_cast<int>(wanted));
    for (int i = 1; i < parts; ++i) {
      points.push_back(advance(from, gradient_[arc], (to.time - from.time) * i / parts));
    }
    points.push_back(to);
  }
  return points;
}

}  // namespace bathyal
