// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/internal/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bathyal::workspace {
namespace {

/// From one speed to another without acceleration at both: the jerk acts for `ramp` at the start
/// and at the end, between them the acceleration is constant for `hold`.
struct SpeedChange {
  double ramp = 0.0;
  double hold = 0.0;
  double jerk = 0.0;
  double way = 0.0;
};

SpeedChange change_of(double from, double to, const Piece& piece) {
  const double change = std::abs(to - from);
  SpeedChange c;
  c.ramp = std::min(piece.acceleration / piece.jerk, std::sqrt(change / piece.jerk));
  // As change = jerk · ramp · (ramp + hold).
  c.hold = c.ramp > 0.0 ? std::max(0.0, change / (piece.jerk * c.ramp) - c.ramp) : 0.0;
  c.jerk = to > from ? piece.jerk : -piece.jerk;
  c.way = 0.5 * (from + to) * (2.0 * c.ramp + c.hold);
  return c;
}

/// The largest value in [low, high] for which `fits`, which holds at low and up to some value.
template <class Fits>
double largest(double low, double high, const Fits& fits) {
  if (fits(high)) return high;
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

/// The speeds where pieces meet: none can be passed at more than either piece allows, nor at more
/// than can be reached from the speed before, or be left in time for the speed after.
std::vector<double> speeds_between(const std::vector<Piece>& pieces) {
  std::vector<double> speed(pieces.size() + 1, 0.0);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    speed[i] = std::min(pieces[i - 1].speed, pieces[i].speed);
  }
  const auto limit = [](const Piece& piece, double from, double& to) {
    if (to <= from) return;
    to = piece.acceleration > 0.0
             ? largest(from, to,
                       [&](double v) { return change_of(from, v, piece).way <= piece.length; })
             : from;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) limit(pieces[i], speed[i], speed[i + 1]);
  for (std::size_t i = pieces.size(); i-- > 0;) limit(pieces[i], speed[i + 1], speed[i]);
  return speed;
}

class Profile {
 public:
  void constant_speed(std::size_t piece, double way, double duration, double speed) {
    add(piece, {.way = way, .duration = duration, .speed = speed});
  }

  void change(std::size_t piece, double way, double from, const SpeedChange& c) {
    const double top = c.jerk * c.ramp;
    Step step{.way = way, .duration = c.ramp, .speed = from, .jerk = c.jerk};
    step = add(piece, step);
    step.jerk = 0.0;
    step.acceleration = top;
    step.duration = c.hold;
    step = add(piece, step);
    step.jerk = -c.jerk;
    step.duration = c.ramp;
    add(piece, step);
  }

  std::vector<Phase> take() { return std::move(phases_); }

 private:
  struct Step {
    double way = 0.0;
    double duration = 0.0;
    double speed = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
  };

  /// The state at the end of the step.
  Step add(std::size_t piece, const Step& s) {
    if (!(s.duration > 0.0)) return s;
    const Phase phase{piece, time_, s.duration, s.way, s.speed, s.acceleration, s.jerk};
    phases_.push_back(phase);
    time_ += s.duration;
    const double t = s.duration;
    return {phase.way_at(phase.start + t), t, s.speed + t * (s.acceleration + t * s.jerk / 2.0),
            s.acceleration + t * s.jerk, s.jerk};
  }

  std::vector<Phase> phases_;
  double time_ = 0.0;
};

}  // namespace

std::vector<Phase> speed_profile(const std::vector<Piece>& pieces) {
  const std::vector<double> speeds = speeds_between(pieces);
  Profile profile;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const double from = speeds[i], to = speeds[i + 1];
    if (piece.length <= 0.0) continue;
    if (!(piece.acceleration > 0.0)) {
      profile.constant_speed(i, 0.0, piece.length / from, from);
      continue;
    }
    const double top = largest(std::max(from, to), piece.speed, [&](double v) {
      return change_of(from, v, piece).way + change_of(v, to, piece).way <= piece.length;
    });
    const SpeedChange up = change_of(from, top, piece), down = change_of(top, to, piece);
    const double cruise = std::max(0.0, piece.length - up.way - down.way);
    profile.change(i, 0.0, from, up);
    profile.constant_speed(i, up.way, cruise / top, top);
    profile.change(i, piece.length - down.way, top, down);
  }
  return profile.take();
}

}  // namespace bathyal::workspace
