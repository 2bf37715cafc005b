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

/// A straight motion in joint space between two rows.
struct Leg {
  const double* from;
  const double* to;
  std::size_t size;

  void at(double fraction, std::vector<double>& q) const {
    for (std::size_t k = 0; k < size; ++k) q[k] = from[k] + fraction * (to[k] - from[k]);
  }
};

class LegSearch {
 public:
  LegSearch(const Bodies& bodies, const Leg& leg)
      : bodies_(&bodies), leg_(leg), posture_(bodies), q_(leg.size), change_(leg.size) {}

  /// The earliest contact of a pair in [0, `before`), or `before`.
  double obstacle(const Pair& pair, double before) {
    // Hull, world and vehicle do not move against the foot.
    const int observer = std::max(0, bodies_->obstacles[pair.other].frame());
    return search(0.0, before, before, pair.capsule, observer,
                  [&](double within) { return posture_.to_obstacle(pair, within).distance; });
  }

  double self(const Pair& pair, double before) {
    return search(0.0, before, before, pair.capsule, bodies_->link_of(pair.other),
                  [&](double) { return posture_.to_capsule(pair); });
  }

 private:
  /// `distance(within)` of the pair in the posture, which may be infinite beyond `within`.
  template <class Distance>
  double search(double low, double high, double none, std::size_t capsule, int observer,
                const Distance& distance) {
    if (!(high > low)) return none;
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    leg_.at(middle, q_);
    for (std::size_t k = 0; k < leg_.size; ++k) {
      change_[k] = half * std::abs(leg_.to[k] - leg_.from[k]);
    }
    posture_.set(q_);
    const double moved =
        displacement_bound(bodies_->arm, posture_.frames(), bodies_->link_of(capsule), observer,
                           posture_.capsule(capsule), change_);
    if (distance(moved) > moved) return none;
    if (2.0 * half <= kResolution && moved <= kTouch) return middle;
    const double earlier = search(low, middle, none, capsule, observer, distance);
    return earlier < none ? earlier : search(middle, high, none, capsule, observer, distance);
  }

  const Bodies* bodies_;
  Leg leg_;
  Posture posture_;
  std::vector<double> q_, change_;
};

}  // namespace

MotionCheck first_contact(const Bodies& bodies, const JointView& q) {
  MotionCheck check;
  const auto size = static_cast<std::size_t>(q.cols());
  const Index legs = std::max<Index>(1, q.rows() - 1);
  for (Index i = 0; i < legs && check.free; ++i) {
    // A single row is a motion that stays where it is.
    const double* from = q.data() + i * q.cols();
    const Leg leg{from, q.rows() > 1 ? from + q.cols() : from, size};
    LegSearch search(bodies, leg);
    const double none = std::nextafter(1.0, 2.0);
    double first = none;
    const auto take = [&](double found, const Pair& pair, bool is_obstacle) {
      if (!(found < first)) return;
      first = found;
      check.link = bodies.link_of(pair.capsule);
      check.obstacle = is_obstacle ? static_cast<int>(pair.other) : -1;
      check.other_link = is_obstacle ? -1 : bodies.link_of(pair.other);
    };
    for (const Pair& pair : bodies.with_obstacles) take(search.obstacle(pair, first), pair, true);
    for (const Pair& pair : bodies.with_capsules) take(search.self(pair, first), pair, false);
    if (first < none) {
      check.free = false;
      check.contact = static_cast<double>(i) + first;
    }
  }
  return check;
}

}  // namespace bathyal::workspace
