// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/rolled_frames.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/toolpath/internal/frames.hpp"
#include "bathyal/toolpath/internal/normals.hpp"

namespace bathyal::toolpath {
namespace {

using Quaternion = Eigen::Quaterniond;

constexpr double kUnturned = 1e-9;  // [rad]: frames that differ less are the same

/// A rest with its frame, and where it is along the way.
struct Station {
  Rest rest;
  Quaternion frame = Quaternion::Identity();
  double at = 0.0;  ///< [m]
  double normal_std = 0.0;
};

/// The turn from station k to station k + 1: all at the second one and to be blended, or spread
/// evenly over the way between them.
struct StationTurn {
  Eigen::AngleAxisd rotation = Eigen::AngleAxisd::Identity();
  bool is_jump = false;
};

struct RolledWay {
  std::vector<Station> stations;
  std::vector<StationTurn> turns;  ///< one less
};

/// Normals of the facets or footprints that are touched, and their standard deviations.
std::vector<std::vector<Piece>> touched_pieces(const RolledRoute& rolled, const Scene& scene,
                                               double normal_radius, int num_threads) {
  Route touched;
  for (const RolledRun& rests : rolled.runs) {
    Run run;
    for (const Rest& rest : rests) {
      Piece piece;
      piece.from = piece.to = rest.touch;
      piece.mesh = rest.mesh;
      piece.triangle = rest.triangle;
      piece.normal = outward_normal(scene, rest.mesh, rest.triangle);
      if (piece.normal.isZero()) piece.normal = rest.approach;
      run.pieces.push_back(piece);
    }
    touched.runs.push_back(std::move(run));
  }
  estimate_normals(touched, scene, normal_radius, num_threads);
  std::vector<std::vector<Piece>> pieces;
  for (Run& run : touched.runs) pieces.push_back(std::move(run.pieces));
  return pieces;
}

RolledWay way_of(const RolledRun& rests, const std::vector<Piece>& touched, bool footprint,
                 const Vec3& onward, const Vec3& before) {
  RolledWay way;
  Vec3 previous = before;
  double at = 0.0;
  for (std::size_t k = 0; k < rests.size(); ++k) {
    if (k > 0) at += (rests[k].centre - rests[k - 1].centre).norm();
    Station station{rests[k], Quaternion::Identity(), at, touched[k].normal_std};
    if (footprint) station.rest.approach = touched[k].normal;
    const Vec3 ahead = rests[k].travel.isZero() ? onward : rests[k].travel;
    station.frame = Quaternion(tool_frame(station.rest.approach, ahead, previous));
    previous = station.frame * Vec3::UnitX();
    way.stations.push_back(station);
  }
  for (std::size_t k = 1; k < way.stations.size(); ++k) {
    const Quaternion turn = way.stations[k].frame * way.stations[k - 1].frame.conjugate();
    const Eigen::AngleAxisd rotation(turn);
    const bool jumps = footprint || rests[k].is_turn;
    way.turns.push_back({rotation, jumps && rotation.angle() > kUnturned});
  }
  return way;
}

double smooth(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * (3.0 - 2.0 * c);
}

/// What part of turn k is done at `s`.
double done_at(const RolledWay& way, std::size_t k, double s, double blend_length) {
  const double from = way.stations[k].at, to = way.stations[k + 1].at;
  if (way.turns[k].is_jump) return smooth((s - to) / blend_length + 0.5);
  if (to > from) return std::clamp((s - from) / (to - from), 0.0, 1.0);
  return s >= to ? 1.0 : 0.0;
}

/// Halfway between the turns done one after the other from behind and undone from ahead.
Quaternion blended_at(const RolledWay& way, double s, double blend_length) {
  const double half = 0.5 * blend_length;
  const auto by_place = [](const Station& station, double at) { return station.at < at; };
  const auto place_by = [](double at, const Station& station) { return at < station.at; };
  const auto begin = way.stations.begin(), end = way.stations.end();
  const auto before = std::lower_bound(begin, end, s - half, by_place);
  const auto after = std::upper_bound(begin, end, s + half, place_by);
  // One station further out on either side: the turns that reach into the window.
  const auto low = static_cast<std::size_t>(std::max<std::ptrdiff_t>(before - begin - 1, 0));
  const auto high = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
      after - begin, static_cast<std::ptrdiff_t>(way.stations.size()) - 1));
  Quaternion behind = way.stations[low].frame, ahead = way.stations[high].frame;
  for (std::size_t k = low; k < high; ++k) {
    const Eigen::AngleAxisd& turn = way.turns[k].rotation;
    behind =
        Eigen::AngleAxisd(done_at(way, k, s, blend_length) * turn.angle(), turn.axis()) * behind;
  }
  for (std::size_t k = high; k-- > low;) {
    const Eigen::AngleAxisd& turn = way.turns[k].rotation;
    ahead =
        Eigen::AngleAxisd((done_at(way, k, s, blend_length) - 1.0) * turn.angle(), turn.axis()) *
        ahead;
  }
  return behind.slerp(0.5, ahead).normalized();
}

void append_sample(ToolPath& path, const Station& station, const Quaternion& frame) {
  Quaternion q = frame;
  if (!path.quaternion.empty()) {
    const auto& last = path.quaternion.back();
    if (q.dot(Quaternion(last[3], last[0], last[1], last[2])) < 0.0) q.coeffs() = -q.coeffs();
  }
  const Eigen::Matrix3d axes = q.toRotationMatrix();
  path.position.push_back(station.rest.centre);
  path.surface.push_back(station.rest.touch);
  path.travel.emplace_back(axes.col(0));
  path.side.emplace_back(-axes.col(1));
  path.approach.emplace_back(-axes.col(2));
  path.quaternion.push_back({q.x(), q.y(), q.z(), q.w()});
  path.segment.push_back(station.rest.segment);
  path.mesh.push_back(station.rest.mesh);
  path.triangle.push_back(station.rest.triangle);
  path.gap.push_back(false);
  path.crossing.push_back(station.rest.is_backward);
  path.normal_std.push_back(station.normal_std);
}

/// The place at `fraction` of the way from `a` to `b`: on the line between them where that is
/// straight, else where the ball touches there.
Station between(const Ball& ball, const Station& a, const Station& b, double fraction) {
  Station middle = a;
  middle.rest.is_turn = false;
  middle.at = a.at + fraction * (b.at - a.at);
  middle.rest.centre = a.rest.centre + fraction * (b.rest.centre - a.rest.centre);
  const Vec3 a_out = a.rest.centre - a.rest.touch, b_out = b.rest.centre - b.rest.touch;
  const bool is_straight = (a_out - b_out).norm() <= 1e-9 * ball.radius();
  if (is_straight && ball.is_free(middle.rest.centre)) {
    middle.rest.touch = middle.rest.centre - (a_out + fraction * (b_out - a_out));
    return middle;
  }
  const Vec3 out = (a.rest.approach + b.rest.approach).normalized();
  const RollingPlane plane{a.rest.centre, b.rest.travel.cross(out).normalized(), 1.0};
  const Vec3 on = middle.rest.centre;
  const double chord = (b.rest.centre - a.rest.centre).norm();
  const auto settled = settle(ball, plane, a.rest.mesh, a.rest.triangle, on);
  if (settled && (*settled - on).norm() < 0.05 * chord && ball.is_free(*settled)) {
    middle.rest.centre = *settled;
  } else if (const auto up = ball.lay(on, out)) {
    middle.rest.centre = *up;
  }
  const Touch touch = ball.nearest(middle.rest.centre);
  middle.rest.touch = touch.point;
  middle.rest.mesh = touch.mesh;
  middle.rest.triangle = touch.triangle;
  return middle;
}

std::size_t parts_in(double length, double longest) {
  if (!(longest > 0.0) || length <= kCoincident) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length / longest * (1.0 - 1e-12))));
}

/// Samples of the stretch from station k on to the next, the next left out: finer where a jump's
/// blend reaches into it, and where parts of `step` come out longer than `most`.
std::vector<Station> stretch_of(const Ball& ball, const RolledWay& way, std::size_t k,
                                double last_jump, double next_jump, double blend_length,
                                double step, double most) {
  const Station &a = way.stations[k], &b = way.stations[k + 1];
  std::vector<double> cuts{a.at};
  const double fine = step > 0.0 ? std::min(step, blend_length / 8.0) : blend_length / 8.0;
  const auto cut = [&](double end, double longest) {
    const double begin = cuts.back();
    if (end - begin <= kCoincident) return;
    const std::size_t parts = parts_in(end - begin, longest);
    for (std::size_t i = 1; i <= parts; ++i) {
      cuts.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(parts));
    }
  };
  const double turned = std::min(last_jump + 0.5 * blend_length, b.at);
  const double turning = std::min(next_jump - 0.5 * blend_length, b.at);
  if (turned >= turning) {
    cut(b.at, fine);
  } else {
    cut(turned, fine);
    cut(turning, step);
    cut(b.at, fine);
  }
  std::vector<Station> stations{a};
  const double length = b.at - a.at;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (b.at - cuts[i] <= kCoincident) break;
    stations.push_back(between(ball, a, b, (cuts[i] - a.at) / length));
  }
  // Off the straight line parts differ in length.
  if (step <= 0.0 || length > 1e3 * step) return stations;
  double longest = (b.rest.centre - stations.back().rest.centre).norm();
  for (std::size_t i = 1; i < stations.size(); ++i) {
    longest = std::max(longest, (stations[i].rest.centre - stations[i - 1].rest.centre).norm());
  }
  if (longest <= most * (1.0 + 1e-9) || step < most / 16.0) return stations;
  return stretch_of(ball, way, k, last_jump, next_jump, blend_length, 0.5 * step, most);
}

void append_run(ToolPath& path, const Ball& ball, const RolledWay& way,
                const ToolPathOptions& options) {
  const double blend_length = std::min(options.blend_length, 2.0 * ball.radius());
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool blended = options.orientation == Orientation::kBlended;
  const std::size_t count = way.stations.size();
  std::vector<double> next_jump(count, kFar);  // after station k
  for (std::size_t k = count - 1; k-- > 0;) {
    next_jump[k] = way.turns[k].is_jump ? way.stations[k + 1].at : next_jump[k + 1];
  }
  double last_jump = -kFar;
  for (std::size_t k = 0; k < count; ++k) {
    if (k > 0 && way.turns[k - 1].is_jump) last_jump = way.stations[k].at;
    const bool is_last = k + 1 == count;
    std::vector<Station> samples{way.stations[k]};
    if (!is_last) {
      samples =
          blended ? stretch_of(ball, way, k, last_jump, next_jump[k], blend_length, options.step,
                               options.step)
                  : stretch_of(ball, way, k, -kFar, kFar, blend_length, options.step, options.step);
      // Of two stations at one place the second is the blended sample.
      const bool in_place = way.stations[k + 1].at - way.stations[k].at <= kCoincident;
      if (blended && in_place) continue;
    }
    for (const Station& sample : samples) {
      Quaternion frame = way.stations[k].frame;
      if (blended) {
        frame = blended_at(way, sample.at, blend_length);
      } else if (!is_last && !way.turns[k].is_jump) {
        const double part = done_at(way, k, sample.at, blend_length);
        const Eigen::AngleAxisd& turn = way.turns[k].rotation;
        frame = Quaternion(Eigen::AngleAxisd(part * turn.angle(), turn.axis())) * frame;
      }
      append_sample(path, sample, frame);
    }
  }
}

}  // namespace

ToolPath sample_rolled(const RolledRoute& rolled, const Route& route, const Scene& scene,
                       const ToolPathOptions& options) {
  const Ball ball(scene, options.standoff);
  const auto touched =
      touched_pieces(rolled, scene, options.normal_radius, options.targets.num_threads);
  ToolPath path;
  for (std::size_t r = 0; r < rolled.runs.size(); ++r) {
    const Vec3 before = path.size() > 0 ? path.travel.back() : Vec3(Vec3::Zero());
    Vec3 onward = before;
    if (r + 1 < rolled.runs.size()) {
      onward = rolled.runs[r + 1].front().centre - rolled.runs[r].back().centre;
    } else if (path.size() > 0) {
      onward = rolled.runs[r].front().centre - path.position.back();
    }
    append_run(path, ball,
               way_of(rolled.runs[r], touched[r], options.normal_radius > 0.0, onward, before),
               options);
    if (r + 1 == rolled.runs.size()) continue;
    path.gap.back() = true;
    path.segment.back() = route.runs[r].gap_segment;
  }
  return path;
}

}  // namespace bathyal::toolpath
