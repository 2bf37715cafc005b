// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bathyal::workspace {
namespace {

constexpr double kTouch = 1e-5;       // [m]; an interval that moves less is not halved further
constexpr double kResolution = 1e-3;  // of a row; the place of a contact

/// A straight motion in joint space between two rows, and on along its line.
struct Leg {
  const double* from;
  const double* to;
  std::size_t size;
  double start = 0.0, duration = 0.0;  // [s]
  double stopping = 0.0;       // how far it runs on after the order to stop, as a part of the leg
  double stop_duration = 0.0;  // and for how long [s]

  void at(double fraction, std::vector<double>& q) const {
    for (std::size_t k = 0; k < size; ++k) q[k] = from[k] + fraction * (to[k] - from[k]);
  }
  double time(double fraction) const { return start + fraction * duration; }
};

/// The arm brakes along the leg's line, as hard as its weakest coordinate can.
void add_stopping(Leg& leg, std::span<const double> acceleration) {
  if (!(leg.duration > 0.0)) return;
  for (std::size_t k = 0; k < leg.size; ++k) {
    const double speed = std::abs(leg.to[k] - leg.from[k]) / leg.duration;
    leg.stop_duration = std::max(leg.stop_duration, speed / acceleration[k]);
  }
  leg.stopping = 0.5 * leg.stop_duration / leg.duration;
}

class LegSearch {
 public:
  LegSearch(const Bodies& bodies, const Trajectory& world_from_vehicle, const Leg& leg)
      : bodies_(&bodies),
        leg_(&leg),
        posture_(bodies, world_from_vehicle),
        q_(leg.size),
        change_(leg.size) {}

  /// The earliest contact of a pair in [0, `before`), or `before`.
  double obstacle(const Pair& pair, double before) {
    // Vehicle and world are seen from the foot; what they move by is the drift.
    const int observer = std::max(0, bodies_->obstacles[pair.other].frame());
    const double steepness =
        1.0 + (bodies_->is_in_world(pair.other) ? 3.0 * bodies_->angle_std : 0.0);
    const auto moved = [&](double half) {
      return steepness * arm_moves(pair.capsule, observer, half) +
             posture_.drift(pair, half * leg_->duration);
    };
    const auto distance = [&](double within) {
      // While it stops, the arm is where it is later than the rows say.
      const double late = posture_.drift(pair, leg_->stop_duration);
      return posture_.to_obstacle(pair, within + late).distance - late;
    };
    return search(0.0, before, before, moved, distance);
  }

  /// Whether a pair touches at the start.
  bool touches(const Pair& pair, bool is_obstacle) {
    leg_->at(0.0, q_);
    posture_.set(q_, leg_->time(0.0));
    return (is_obstacle ? posture_.to_obstacle(pair, 0.0).distance : posture_.to_capsule(pair)) <=
           0.0;
  }

  double self(const Pair& pair, double before) {
    const auto moved = [&](double half) {
      return arm_moves(pair.capsule, bodies_->link_of(pair.other), half);
    };
    const auto distance = [&](double) { return posture_.to_capsule(pair); };
    return search(0.0, before, before, moved, distance);
  }

 private:
  /// By how much the arm takes a point of the capsule along in `half` of the leg before and after
  /// the posture.
  double arm_moves(std::size_t capsule, int observer, double half) {
    for (std::size_t k = 0; k < leg_->size; ++k) {
      change_[k] = half * std::abs(leg_->to[k] - leg_->from[k]);
    }
    return displacement_bound(bodies_->arm, posture_.frames(), bodies_->link_of(capsule), observer,
                              posture_.capsule(capsule), change_);
  }

  /// `moved(half)` bounds the motion around the posture, `distance(within)` is that of the pair in
  /// it, which may be infinite beyond `within`.
  template <class Moved, class Distance>
  double search(double low, double high, double none, const Moved& moved,
                const Distance& distance) {
    if (!(high > low)) return none;
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    leg_->at(middle, q_);
    posture_.set(q_, leg_->time(middle));
    const double needed = moved(half);
    if (distance(needed) > needed) return none;
    if (2.0 * half <= kResolution && needed <= kTouch) return middle;
    const double earlier = search(low, middle, none, moved, distance);
    return earlier < none ? earlier : search(middle, high, none, moved, distance);
  }

  const Bodies* bodies_;
  const Leg* leg_;
  Posture posture_;
  std::vector<double> q_, change_;
};

}  // namespace

MotionCheck first_contact(const Bodies& bodies, const Trajectory& world_from_vehicle,
                          const JointView& q, const MotionOptions& options) {
  MotionCheck check;
  const auto size = static_cast<std::size_t>(q.cols());
  const Index legs = std::max<Index>(1, q.rows() - 1);
  for (Index i = 0; i < legs && check.free; ++i) {
    // A single row is a motion that stays where it is.
    const double* from = q.data() + i * q.cols();
    Leg leg{from, q.rows() > 1 ? from + q.cols() : from, size};
    if (!options.time.empty()) {
      const auto row = static_cast<std::size_t>(i);
      leg.start = options.time[row];
      if (q.rows() > 1) leg.duration = options.time[row + 1] - leg.start;
    }
    if (options.stopping) add_stopping(leg, options.acceleration);
    LegSearch search(bodies, world_from_vehicle, leg);
    const double none = std::nextafter(1.0 + leg.stopping, 3.0);
    double first = none;
    const auto take = [&](double found, const Pair& pair, bool is_obstacle) {
      if (!(found < first)) return;
      first = found;
      check.link = bodies.link_of(pair.capsule);
      check.obstacle = is_obstacle ? static_cast<int>(pair.other) : -1;
      check.other_link = is_obstacle ? -1 : bodies.link_of(pair.other);
    };
    const auto look = [&](const Pair& pair, bool is_obstacle) {
      if (i == 0 && search.touches(pair, is_obstacle)) return take(0.0, pair, is_obstacle);
      take(is_obstacle ? search.obstacle(pair, first) : search.self(pair, first), pair,
           is_obstacle);
    };
    for (const Pair& pair : bodies.obstacle_pairs(options.tip_contact)) look(pair, true);
    for (const Pair& pair : bodies.with_capsules) look(pair, false);
    if (first < none) {
      check.free = false;
      // The last moment at which the order to stop would have come in time.
      first = std::max(0.0, first - leg.stopping);
      check.contact = static_cast<double>(i) + first;
      if (!options.time.empty()) check.time = leg.time(first);
    }
  }
  return check;
}

}  // namespace bathyal::workspace
