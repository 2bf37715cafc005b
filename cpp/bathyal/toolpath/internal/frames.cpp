// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::toolpath {
namespace {

constexpr double kNoTurn = 1e-9;  // [rad]: frames that differ less are the same
using Quaternion = Eigen::Quaterniond;

Vec3 direction_of(const Piece& piece) {
  const Vec3 step = piece.to - piece.from;
  const double length = step.norm();
  return length > 0.0 ? Vec3(step / length) : Vec3(Vec3::Zero());
}

/// One frame a piece. A lone point looks to where the path goes on beyond the gap.
std::vector<Eigen::Matrix3d> frames_of(const Run& run, const Vec3& onward, const Vec3& before) {
  std::vector<Eigen::Matrix3d> frames;
  Vec3 previous = before;
  for (const Piece& piece : run.pieces) {
    const Vec3 direction = direction_of(piece);
    frames.push_back(tool_frame(piece.normal, direction.isZero() ? onward : direction, previous));
    previous = frames.back().col(0);
  }
  return frames;
}

void append(ToolPath& path, const Piece& piece, const Vec3& point, const Eigen::Matrix3d& frame) {
  Quaternion q(frame);
  if (!path.quaternion.empty()) {
    const auto& last = path.quaternion.back();
    if (q.dot(Quaternion(last[3], last[0], last[1], last[2])) < 0.0) q.coeffs() = -q.coeffs();
  }
  path.surface.push_back(point);
  path.position.push_back(point);
  path.travel.emplace_back(frame.col(0));
  path.side.emplace_back(-frame.col(1));
  path.approach.emplace_back(-frame.col(2));
  path.quaternion.push_back({q.x(), q.y(), q.z(), q.w()});
  path.segment.push_back(piece.segment);
  path.mesh.push_back(piece.mesh);
  path.triangle.push_back(piece.triangle);
  path.gap.push_back(false);
  path.normal_std.push_back(piece.normal_std);
}

/// Number of equal parts no longer than step; 1 where no step is asked for.
std::size_t parts_of(double length, double step) {
  if (step <= 0.0) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length / step * (1.0 - 1e-12))));
}

double turn_angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Quaternion(a).angularDistance(Quaternion(b));
}

void append_piecewise(ToolPath& path, const Run& run, const std::vector<Eigen::Matrix3d>& frames,
                      double step) {
  for (std::size_t k = 0; k < run.pieces.size(); ++k) {
    const Piece& piece = run.pieces[k];
    const bool goes_on = k > 0 && run.pieces[k - 1].triangle == piece.triangle &&
                         run.pieces[k - 1].mesh == piece.mesh &&
                         turn_angle(frames[k - 1], frames[k]) <= kNoTurn;
    if (goes_on) {
      path.segment.back() = piece.segment;
    } else {
      append(path, piece, piece.from, frames[k]);
    }
    if (piece.length() == 0.0) continue;
    const std::size_t parts = parts_of(piece.length(), step);
    for (std::size_t i = 1; i < parts; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(parts);
      append(path, piece, piece.from + fraction * (piece.to - piece.from), frames[k]);
    }
    append(path, piece, piece.to, frames[k]);
  }
}

/// The rotation from one piece's frame to the next's.
struct Turn {
  double at = 0.0;  ///< arc length [m]
  Vec3 axis = Vec3::UnitZ();
  double angle = 0.0;  ///< [rad], 0 to π
};

std::vector<Turn> turns_of(const std::vector<double>& starts,
                           const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<Turn> turns;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const Quaternion q(Eigen::Matrix3d(frames[k] * frames[k - 1].transpose()));
    const Eigen::AngleAxisd rotation(q);
    turns.push_back({starts[k], rotation.axis(), rotation.angle()});
  }
  return turns;
}

/// Appends the ends of equal parts of [knots.back(), end] no longer than `longest`.
void divide(std::vector<double>& knots, double end, double longest) {
  const double begin = knots.back();
  if (end - begin <= kCoincident) return;
  const std::size_t parts = parts_of(end - begin, longest);
  for (std::size_t i = 1; i < parts; ++i) {
    knots.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(parts));
  }
  knots.push_back(end);
}

/// Arc lengths of the samples of one run, rising: the ends of pieces, and parts of each piece,
/// finer where a turn reaches into it from its nearest neighbour on either side.
std::vector<double> knots_of(const std::vector<double>& starts, const std::vector<Turn>& turns,
                             double blend_length, double step) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double fine = step > 0.0 ? std::min(step, blend_length / 8.0) : blend_length / 8.0;
  const std::size_t pieces = starts.size() - 1;
  std::vector<double> next_turn(pieces, kFar);  // arc length of the first real turn after a piece
  for (std::size_t k = pieces - 1; k-- > 0;) {
    next_turn[k] = turns[k].angle > kNoTurn ? turns[k].at : next_turn[k + 1];
  }
  std::vector<double> knots{0.0};
  double last_turn = -kFar;
  for (std::size_t k = 0; k < pieces; ++k) {
    if (k > 0 && turns[k - 1].angle > kNoTurn) last_turn = turns[k - 1].at;
    const double turned = last_turn + 0.5 * blend_length;      // the turn behind is done here
    const double turning = next_turn[k] - 0.5 * blend_length;  // the turn ahead begins here
    const double end = starts[k + 1];
    if (turned >= turning) {
      divide(knots, end, fine);
    } else {
      divide(knots, std::min(turned, end), fine);
      divide(knots, std::clamp(turning, knots.back(), end), step);
      divide(knots, end, turning < end ? fine : step);
    }
    if (knots.back() == end) continue;
    if (knots.back() > starts[k]) knots.pop_back();  // the rest is too short for a part of its own
    knots.push_back(end);
  }
  return knots;
}

double smooth_step(double x) {
  const double c = std::clamp(x, 0.0, 1.0);
  return c * c * (3.0 - 2.0 * c);
}

/// R(s). All turns before `first` are done. Built up from behind and built back from ahead, which
/// differ where turns overlap since rotations do not commute; halfway between is the same for a
/// path and the reversed path.
Eigen::Matrix3d blended_frame(const std::vector<Eigen::Matrix3d>& frames,
                              const std::vector<Turn>& turns, std::size_t first, double s,
                              double blend_length) {
  const auto done = [&](const Turn& turn) {
    return smooth_step((s - turn.at) / blend_length + 0.5);
  };
  std::size_t last = first;
  while (last < turns.size() && turns[last].at - 0.5 * blend_length < s) ++last;
  if (first == last) return frames[first];
  Quaternion behind(frames[first]), ahead(frames[last]);
  for (std::size_t k = first; k < last; ++k) {
    behind = Eigen::AngleAxisd(done(turns[k]) * turns[k].angle, turns[k].axis) * behind;
  }
  for (std::size_t k = last; k-- > first;) {
    ahead = Eigen::AngleAxisd((done(turns[k]) - 1.0) * turns[k].angle, turns[k].axis) * ahead;
  }
  return behind.slerp(0.5, ahead).normalized().toRotationMatrix();
}

void append_blended(ToolPath& path, const Run& run, const std::vector<Eigen::Matrix3d>& frames,
                    double blend_length, double step) {
  std::vector<double> starts{0.0};
  for (const Piece& piece : run.pieces) starts.push_back(starts.back() + piece.length());
  const std::vector<Turn> turns = turns_of(starts, frames);
  std::size_t piece = 0, first = 0;
  for (const double s : knots_of(starts, turns, blend_length, step)) {
    while (piece + 1 < run.pieces.size() && s >= starts[piece + 1]) ++piece;
    while (first < turns.size() && turns[first].at + 0.5 * blend_length <= s) ++first;
    const Eigen::Matrix3d frame = blended_frame(frames, turns, first, s, blend_length);
    const Piece& on = run.pieces[piece];
    const double along = on.length() > 0.0 ? (s - starts[piece]) / on.length() : 0.0;
    const Vec3 point = s >= starts[piece + 1] ? on.to : Vec3(on.from + along * (on.to - on.from));
    append(path, on, point, frame);
  }
}

/// Calls `append_run(path, run, frames)` for every run and sets the gap flags between them.
template <class AppendRun>
ToolPath sample(const Route& route, const AppendRun& append_run) {
  ToolPath path;
  for (std::size_t r = 0; r < route.runs.size(); ++r) {
    const Run& run = route.runs[r];
    const Vec3 before = path.size() > 0 ? path.travel.back() : Vec3(Vec3::Zero());
    Vec3 onward = before;
    if (r + 1 < route.runs.size()) {
      onward = route.runs[r + 1].pieces.front().from - run.pieces.back().to;
    } else if (path.size() > 0) {
      onward = run.pieces.front().from - path.surface.back();
    }
    append_run(path, run, frames_of(run, onward, before));
    if (r + 1 == route.runs.size()) continue;
    path.gap.back() = true;
    path.segment.back() = run.gap_segment;
  }
  return path;
}

}  // namespace

Eigen::Matrix3d tool_frame(const Vec3& approach, const Vec3& direction, const Vec3& fallback) {
  constexpr double kAlong = 1e-6;  // a direction this close to a has no heading
  Vec3 travel = Vec3::Zero();
  for (const Vec3& candidate : {direction, fallback, Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const double length = candidate.norm();
    if (!(length > 0.0)) continue;
    travel = candidate / length;
    travel -= travel.dot(approach) * approach;
    if (travel.norm() > kAlong) break;
  }
  travel.normalize();
  travel = (travel - travel.dot(approach) * approach).normalized();
  Eigen::Matrix3d frame;
  frame << travel, -approach.cross(travel), -approach;
  return frame;
}

ToolPath sample_piecewise_constant(const Route& route, double step) {
  return sample(route, [&](ToolPath& path, const Run& run, const auto& frames) {
    append_piecewise(path, run, frames, step);
  });
}

ToolPath sample_blended(const Route& route, double blend_length, double step) {
  return sample(route, [&](ToolPath& path, const Run& run, const auto& frames) {
    append_blended(path, run, frames, blend_length, step);
  });
}

double turn_between(const ToolPath& path, std::size_t i, std::size_t j) {
  const auto& a = path.quaternion[i];
  const auto& b = path.quaternion[j];
  return Quaternion(a[3], a[0], a[1], a[2]).angularDistance(Quaternion(b[3], b[0], b[1], b[2]));
}

}  // namespace bathyal::toolpath
