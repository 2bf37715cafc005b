// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/rolling.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "bathyal/base/parallel.hpp"

namespace bathyal::toolpath {
namespace {

using Pieces = std::span<const Piece>;

/// The pieces of one run between two targets.
struct RunLeg {
  std::size_t run;
  Pieces pieces;
  RollingPlane plane;
};

struct RolledLeg {
  std::vector<Rest> rests;
  bool is_rolled = true;
};

double length_of(Pieces pieces) {
  double length = 0.0;
  for (const Piece& piece : pieces) length += piece.length();
  return length;
}

double way_of(const std::vector<Rest>& rests) {
  double way = 0.0;
  for (std::size_t k = 1; k < rests.size(); ++k) {
    way += (rests[k].centre - rests[k - 1].centre).norm();
  }
  return way;
}

/// Across the leg: from its targets, or where one lies above the other from the pieces themselves.
Vec3 across(Pieces pieces, const Targets& targets, const Vec3& up) {
  const auto i = static_cast<std::size_t>(pieces.front().segment);
  const Vec3& a = targets.point[i];
  if (i + 1 < targets.size() && targets.found(i + 1)) {
    const Vec3 r = (targets.point[i + 1] - a).cross(up);
    if (r.norm() > kCoincident + 1e-12 * a.cwiseAbs().maxCoeff()) return r.normalized();
  }
  Vec3 r = Vec3::Zero();
  for (const Piece& piece : pieces) {
    const Vec3 of_piece = (piece.to - piece.from).cross(piece.normal);
    r += r.dot(of_piece) < 0.0 ? Vec3(-of_piece) : of_piece;
  }
  if (!(r.norm() > 0.0)) r = up.unitOrthogonal();
  return r.normalized();
}

RollingPlane plane_of(Pieces pieces, const Targets& targets, const Vec3& up, double radius) {
  constexpr double kSteepest = 0.9;  // further sideways the ball has no way within the plane
  RollingPlane plane;
  plane.normal = across(pieces, targets, up);
  double length = 0.0, aside = 0.0, forward = 0.0;
  for (const Piece& piece : pieces) {
    const Vec3 along = piece.to - piece.from;
    length += along.norm();
    aside += along.norm() * piece.normal.dot(plane.normal);
    forward += plane.normal.cross(piece.normal).dot(along);
  }
  const double mean = length > 0.0 ? std::clamp(aside / length, -kSteepest, kSteepest) : 0.0;
  plane.point = pieces.front().from + radius * mean * plane.normal;
  plane.sense = forward < 0.0 ? -1.0 : 1.0;
  return plane;
}

/// The centre at a target (see roll_along); none where nothing leads out.
std::optional<Vec3> centre_at(const Ball& ball, const RollingPlane& plane, const Vec3& target,
                              const Vec3& normal, const Vec3& up) {
  constexpr double kTouching = 1.02;  // of the radius: the ball's touch is the target's own
  const double reach = 30.0 * ball.radius();
  const Vec3 from = plane.onto(target);
  Vec3 out = plane.within(normal);
  if (out.norm() < 0.1) out = plane.within(up);
  if (out.norm() < 0.1) return std::nullopt;
  out.normalize();
  const std::optional<Vec3> along_normal = ball.lift(from, out, reach);
  if (along_normal && (*along_normal - target).norm() <= kTouching * ball.radius()) {
    return along_normal;
  }
  const Vec3 upwards = plane.within(up).normalized();
  if (normal.dot(up) > 0.1) {
    if (const auto raised = ball.lift(from, upwards, reach)) return raised;
  }
  return along_normal;
}

Rest rest_at(const Ball& ball, const Vec3& centre, const Vec3& travel, std::int32_t segment) {
  const Touch touch = ball.nearest(centre);
  Rest rest{centre, touch.point, touch.toward, travel.normalized(), touch.mesh, touch.triangle};
  rest.segment = segment;
  rest.is_turn = true;
  return rest;
}

/// The plain offset raised along the normals.
std::vector<Rest> raised(const Ball& ball, Pieces pieces) {
  std::vector<Rest> rests;
  for (const Piece& piece : pieces) {
    for (const Vec3& end : {piece.from, piece.to}) {
      const auto centre = ball.lift(end, piece.normal, 1e3 * ball.radius());
      if (!centre) continue;
      Rest rest = rest_at(ball, *centre, piece.to - piece.from, piece.segment);
      if (rest.travel.isZero()) rest.travel = rests.empty() ? Vec3::UnitX() : rests.back().travel;
      append_rest(rests, rest);
    }
  }
  return rests;
}

/// Straight on from one centre to another, raised or lowered till the ball touches.
void go_straight(const Ball& ball, std::vector<Rest>& rests, const Rest& to) {
  const Rest from = rests.back();
  const Vec3 way = to.centre - from.centre;
  const auto parts = static_cast<int>(std::ceil(way.norm() / (0.1 * ball.radius())));
  for (int k = 1; k < parts; ++k) {
    const double f = static_cast<double>(k) / parts;
    const Vec3 out = (1.0 - f) * from.approach + f * to.approach;
    const Vec3 on = from.centre + f * way;
    if (!(out.norm() > 0.1)) continue;
    if (const auto up = ball.lay(on, out.normalized())) {
      append_rest(rests, rest_at(ball, *up, way, from.segment));
    }
  }
}

/// The centre at a target where two legs meet at an angle: on the line both their planes share.
std::optional<Vec3> centre_between(const Ball& ball, const RunLeg& before, const RunLeg& after,
                                   const Vec3& up) {
  const Piece& piece = before.pieces.back();
  const Vec3 &r = before.plane.normal, &s = after.plane.normal;
  const double bend = up.dot(r.cross(s));  // sine of the angle
  if (before.run != after.run || std::abs(bend) < 0.2 || piece.normal.dot(up) < 0.1 ||
      after.pieces.front().normal.dot(up) < 0.1 || std::abs(r.dot(up)) + std::abs(s.dot(up)) > 1e-9)
    return std::nullopt;
  const Vec3& target = piece.to;
  const double of_r = r.dot(before.plane.point - target), of_s = s.dot(after.plane.point - target);
  const Vec3 aside = (of_r * s.cross(up) + of_s * up.cross(r)) / bend;
  if (aside.norm() > 1.5 * ball.radius()) return std::nullopt;
  return ball.lift(target + aside, up, 30.0 * ball.radius());
}

RolledLeg roll_leg(const Ball& ball, const std::vector<RunLeg>& legs, std::size_t k,
                   const Vec3& up) {
  const Pieces pieces = legs[k].pieces;
  RollingPlane plane = legs[k].plane;
  const double length = length_of(pieces);
  const double longest = 6.0 * length + 40.0 * ball.radius();
  std::optional<Vec3> start, goal;
  if (k > 0) start = centre_between(ball, legs[k - 1], legs[k], up);
  if (!start) start = centre_at(ball, plane, pieces.front().from, pieces.front().normal, up);
  if (k + 1 < legs.size()) goal = centre_between(ball, legs[k], legs[k + 1], up);
  if (!goal) goal = centre_at(ball, plane, pieces.back().to, pieces.back().normal, up);
  std::optional<std::vector<Rest>> rests;
  if (start && goal) {
    if (length == 0.0) {
      rests = std::vector<Rest>{rest_at(ball, *start, Vec3::Zero(), 0)};
    } else {
      rests = roll(ball, plane, *start, *goal, longest);
      // Targets closer than the ball is wide may touch it in the other order: on, it would have to
      // go all the way round.
      const double forward = rests ? way_of(*rests) : longest;
      if (forward > 2.0 * (length + ball.radius())) {
        plane.sense = -plane.sense;
        auto back = roll(ball, plane, *start, *goal, std::min(forward, 8.0 * ball.radius()));
        if (back && way_of(*back) < forward) {
          rests = std::move(back);
          for (Rest& rest : *rests) rest.is_backward = true;
        }
      }
    }
  }
  RolledLeg leg;
  leg.is_rolled = rests.has_value();
  leg.rests = rests ? std::move(*rests) : raised(ball, pieces);
  for (Rest& rest : leg.rests) rest.segment = pieces.front().segment;
  return leg;
}

void append_leg(const Ball& ball, RolledRun& run, std::vector<Rest> rests) {
  if (rests.empty()) return;
  if (!run.empty()) {
    rests.front().is_turn = true;
    const double apart = (rests.front().centre - run.back().centre).norm();
    if (apart <= 1e-9 * ball.radius() + 16.0 * ball.slack()) {
      rests.front().centre = run.back().centre;
    } else {
      go_straight(ball, run, rests.front());
    }
  }
  for (const Rest& rest : rests) append_rest(run, rest);
}

}  // namespace

RolledRoute roll_along(const Route& route, const Scene& scene, const Targets& targets,
                       const Vec3& up, double radius, int num_threads) {
  const Ball ball(scene, radius);
  std::vector<RunLeg> legs;
  for (std::size_t r = 0; r < route.runs.size(); ++r) {
    const Pieces pieces(route.runs[r].pieces);
    for (std::size_t begin = 0; begin < pieces.size();) {
      std::size_t end = begin + 1;
      while (end < pieces.size() && pieces[end].segment == pieces[begin].segment) ++end;
      const Pieces leg = pieces.subspan(begin, end - begin);
      legs.push_back({r, leg, plane_of(leg, targets, up, radius)});
      begin = end;
    }
  }
  std::vector<RolledLeg> rolled(legs.size());
  parallel_for(legs.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      rolled[k] = roll_leg(ball, legs, k, up);
    }
  });

  RolledRoute result;
  result.runs.resize(route.runs.size());
  std::vector<std::size_t> plain;
  for (std::size_t k = 0; k < legs.size(); ++k) {
    if (!rolled[k].is_rolled) {
      plain.push_back(static_cast<std::size_t>(legs[k].pieces.front().segment));
    }
    append_leg(ball, result.runs[legs[k].run], std::move(rolled[k].rests));
  }
  warn_of(result.warnings, "segment", plain,
          "cannot be rolled over: the plain offset is kept there, raised off the bottom",
          "cannot be rolled over: the plain offset is kept there, raised off the bottom");
  return result;
}

}  // namespace bathyal::toolpath
