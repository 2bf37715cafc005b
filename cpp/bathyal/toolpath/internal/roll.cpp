// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/roll.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::toolpath {
namespace {

constexpr double kSideways = 1e-7;  // a touch across the plane gives no way within it
constexpr double kStep = 0.1;       // of the radius
constexpr double kMostTurn = 0.1;   // of the approach between two centres [rad]
constexpr double kNoTurn = 1e-9;    // [rad]

/// Follows the outline step by step.
class Roller {
 public:
  Roller(const Ball& ball, const RollingPlane& plane, const Vec3& start)
      : ball_(ball), plane_(plane), centre_(start), step_(kStep * ball.radius()) {
    contact_ = ball.nearest(start);
    add(false);
  }

  /// One step on; false where there is none.
  bool advance() {
    if (sideways(contact_)) return false;
    double length = step_;
    std::optional<Vec3> ahead = step_to(length);
    while (ahead && length > 1e-6 * ball_.radius() && is_too_long(*ahead, length)) {
      length *= 0.5;
      ahead = step_to(length);
    }
    if (!ahead) return false;
    const Touch other = ball_.nearest(*ahead);
    if (other.distance < ball_.radius()) return change_to(other, length);
    const bool is_straight = turn_at(*ahead) <= kNoTurn;
    step_ = is_straight ? 2.0 * length : std::min(kStep * ball_.radius(), 2.0 * length);
    go_to(*ahead);
    return true;
  }

  const Vec3& centre() const { return centre_; }
  const Touch& contact() const { return contact_; }
  Vec3 travel() const { return travel_of(contact_); }
  std::vector<Rest>& rests() { return rests_; }

 private:
  bool sideways(const Touch& touch) const { return plane_.within(touch.toward).norm() < kSideways; }

  Vec3 travel_of(const Touch& touch) const {
    return plane_.sense * plane_.normal.cross(plane_.within(touch.toward)).normalized();
  }

  std::optional<Vec3> step_to(double length) const {
    return settle(ball_, plane_, contact_.mesh, contact_.triangle,
                  centre_ + length * travel_of(contact_));
  }

  Touch same_at(const Vec3& centre) const {
    return ball_.touch(contact_.mesh, contact_.triangle, centre);
  }

  double turn_at(const Vec3& centre) const {
    return (same_at(centre).toward - contact_.toward).norm();
  }

  /// Steps beyond a tenth of the radius are straight and free all along.
  bool is_too_long(const Vec3& ahead, double length) const {
    const double turn = turn_at(ahead);
    if (length <= kStep * ball_.radius()) return turn > kMostTurn;
    return turn > kNoTurn || !ball_.is_free(centre_, ahead);
  }

  void add(bool is_turn) {
    Rest rest{centre_,       contact_.point,   contact_.toward, travel_of(contact_),
              contact_.mesh, contact_.triangle};
    rest.is_turn = is_turn;
    append_rest(rests_, rest);
  }

  void go_to(const Vec3& centre) {
    if ((centre - centre_).norm() > 1e-9 * ball_.radius()) {
      met_.clear();
      stuck_ = 0;
    }
    centre_ = centre;
    contact_ = same_at(centre);
    add(false);
  }

  /// Goes on to where `other` is first touched, and over to it.
  bool change_to(Touch other, double length) {
    const double target = ball_.rolling_radius();
    double free = 0.0;
    std::optional<Vec3> at = centre_;
    for (int tries = 0; tries < 50; ++tries) {
      double low = 0.0, high = length;
      double f_low = ball_.touch(other.mesh, other.triangle, centre_).distance - target;
      double f_high = other.distance - target;
      std::optional<Vec3> best = centre_;
      for (int i = 0; i < 100 && f_low > 0.25 * ball_.slack(); ++i) {
        double middle = low + (high - low) * f_low / (f_low - f_high);
        if (i % 3 == 2 || !(middle > low && middle < high)) middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) break;
        const std::optional<Vec3> there = step_to(middle);
        if (!there) return false;
        const double f = ball_.touch(other.mesh, other.triangle, *there).distance - target;
        if (f >= 0.0) {
          low = middle;
          f_low = f;
          best = there;
        } else {
          high = middle;
          f_high = f;
        }
      }
      free = low;
      at = best;
      const Touch nearer = ball_.nearest(*at);
      if (nearer.distance >= ball_.radius() || free == 0.0) break;
      other = nearer;
      length = free;
    }
    if (free > 0.0) go_to(*at);
    return hand_over(ball_.touch(other.mesh, other.triangle, centre_));
  }

  /// Of all triangles met at this centre the one whose outline leads on free of the others.
  bool hand_over(const Touch& other) {
    if (++stuck_ > 60) return false;
    const auto is_met = [&](const Touch& touch) {
      return std::any_of(met_.begin(), met_.end(), [&](const Touch& m) {
        return m.mesh == touch.mesh && m.triangle == touch.triangle;
      });
    };
    if (!is_met(contact_)) met_.push_back(contact_);
    if (is_met(other)) {
      // Rounding decides nothing here: a hair further out it will.
      Vec3 out = Vec3::Zero();
      for (const Touch& m : met_) out += plane_.within(m.toward);
      if (out.norm() < kSideways) return false;
      centre_ += 4.0 * ball_.slack() * std::min(stuck_, 8) * out.normalized();
    } else {
      met_.push_back(other);
    }
    const Touch* best = nullptr;
    double best_margin = -2.0;
    for (const Touch& candidate : met_) {
      if (sideways(candidate)) continue;
      const Vec3 way = travel_of(candidate);
      double margin = 2.0;
      for (const Touch& m : met_) {
        if (&m != &candidate) margin = std::min(margin, m.toward.dot(way));
      }
      if (margin > best_margin + 1e-12 ||
          (margin > best_margin - 1e-12 && &candidate == &met_.back())) {
        best = &candidate;
        best_margin = margin;
      }
    }
    if (best == nullptr) return false;
    const double turn = (best->toward - contact_.toward).norm();
    contact_ = ball_.touch(best->mesh, best->triangle, centre_);
    step_ = kStep * ball_.radius();
    add(turn > 1e-6);
    return true;
  }

  const Ball& ball_;
  const RollingPlane& plane_;
  Vec3 centre_;
  double step_;
  Touch contact_;
  std::vector<Touch> met_;  // triangles touched at this centre
  int stuck_ = 0;
  std::vector<Rest> rests_;
};

}  // namespace

std::optional<Vec3> settle(const Ball& ball, const RollingPlane& plane, std::int32_t mesh,
                           std::int32_t triangle, Vec3 near) {
  near = plane.onto(near);
  // The distance from a triangle is convex: from outside, Newton's steps stay outside.
  for (int i = 0; i < 60; ++i) {
    const Touch touch = ball.touch(mesh, triangle, near);
    const double over = touch.distance - ball.rolling_radius();
    if (std::abs(over) <= 0.25 * ball.slack()) break;
    const Vec3 out = plane.within(touch.toward);
    const double slope = out.squaredNorm();
    if (slope < kSideways * kSideways) return std::nullopt;
    near = plane.onto(near - over / slope * out);
  }
  return near;
}

void append_rest(std::vector<Rest>& rests, const Rest& rest) {
  const auto continues = [&](const Rest& a, const Rest& b) {
    return a.mesh == b.mesh && a.triangle == b.triangle &&
           (a.approach - b.approach).norm() < kNoTurn && (a.travel - b.travel).norm() < kNoTurn;
  };
  if (!rests.empty() && !rest.is_turn && (rests.back().centre - rest.centre).norm() == 0.0 &&
      (rests.back().approach - rest.approach).norm() < 1e-6) {
    // On to a neighbour without a turn. Where that begins is known to half the digits only: on a
    // straight way the approach stays what it was.
    Rest& last = rests.back();
    const bool is_straight =
        rests.size() > 1 && (rests[rests.size() - 2].approach - last.approach).norm() < kNoTurn;
    const Rest kept = last;
    last = rest;
    if (is_straight) {
      last.touch = kept.touch;
      last.approach = kept.approach;
      last.travel = kept.travel;
    }
    last.is_turn = kept.is_turn;
    return;
  }
  if (!rests.empty() && rest.is_turn && rests.back().is_turn &&
      (rests.back().centre - rest.centre).norm() <= 1e-9 * (rest.centre - rest.touch).norm()) {
    rests.back() = rest;  // tried and found to lead into another triangle
    return;
  }
  const std::size_t n = rests.size();
  if (n >= 2 && !rest.is_turn && !rests[n - 1].is_turn && continues(rests[n - 2], rests[n - 1]) &&
      continues(rests[n - 1], rest)) {
    rests.pop_back();
  }
  rests.push_back(rest);
}

std::optional<std::vector<Rest>> roll(const Ball& ball, const RollingPlane& plane,
                                      const Vec3& start, const Vec3& goal, double longest) {
  const double near = 16.0 * ball.slack() + 1e-9 * ball.radius();
  Roller roller(ball, plane, start);
  double length = 0.0;
  const auto most = static_cast<std::size_t>(std::min(2e6, 1e5 + 200.0 * longest / ball.radius()));
  if ((goal - start).norm() <= near) return std::move(roller.rests());
  for (std::size_t i = 0; i < most && length <= longest; ++i) {
    const Vec3 from = roller.centre();
    if (!roller.advance()) return std::nullopt;
    const Vec3 moved = roller.centre() - from;
    const double way = moved.norm();
    length += way;
    const Vec3 to_goal = goal - from;
    const double along = way > 0.0 ? to_goal.dot(moved) / way : 0.0;
    const double aside = way > 0.0 ? (to_goal - along / way * moved).norm() : to_goal.norm();
    // Between two centres the way bulges by far less than a tenth of their distance.
    if (along < -near || along > way + near ||
        aside > 0.1 * std::min(way, kStep * ball.radius()) + near)
      continue;
    std::vector<Rest> rests = std::move(roller.rests());
    // The last step went past the goal.
    while (rests.size() > 1 && rests.back().centre == roller.centre()) rests.pop_back();
    const Touch touch = ball.nearest(goal);
    Rest last{goal, touch.point, touch.toward, roller.travel(), touch.mesh, touch.triangle};
    last.is_turn = (last.approach - rests.back().approach).norm() > 2.0 * kMostTurn;
    append_rest(rests, last);
    return rests;
  }
  return std::nullopt;
}

}  // namespace bathyal::toolpath
