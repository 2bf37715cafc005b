// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/motion/follow.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/motion/internal/row_timing.hpp"
#include "bathyal/workspace/motion/internal/start_postures.hpp"
#include "bathyal/workspace/motion/internal/tip_motion.hpp"
#include "bathyal/workspace/motion/internal/transit.hpp"
#include "bathyal/workspace/motion/motion_timing.hpp"
#include "bathyal/workspace/motion/stepping.hpp"

namespace bathyal {
namespace {

using Eigen::VectorXd;
using workspace::PathFollower;
using workspace::PathRow;
using workspace::Stretch;

constexpr double kSmallest = 1e-9;  // change between rows that are kept both [rad], [m]

void check_path(const ToolPath& path) {
  if (path.size() == 0) throw_argument("path", "one sample or more", "none");
  for (std::size_t j = 0; j < path.size(); ++j) check_rigid("path", path.frame(j));
}

/// Ways to go on from where the motion is, and the one taken.
class FollowedRows {
 public:
  FollowedRows(const Workspace& ws, PathFollower& follower, const FollowOptions& options)
      : ws_(ws), options_(options), follower_(follower), transit_(ws, follower, options) {}

  std::vector<PathRow>& rows() { return rows_; }
  std::vector<FollowCut>& cuts() { return cuts_; }

  /// Stretch by stretch, to the end of the path.
  void run() {
    std::int32_t at = 0;
    FollowCut halt;
    while (at < follower_.size()) {
      const std::int32_t next = next_begin(at);
      if (next > at) cut_from(at, halt_at(at));
      if (next == follower_.size()) break;
      at = next;
      if (!begin(at, halt)) {
        cut_from(at, halt);
        ++at;
        continue;
      }
      end_cut(at);
      at = ended_ + 1;
      if (complete_) continue;
      // The last sample of a stretch begins the next one, in another posture: unless that goes no
      // farther.
      cut_from(ended_, next_begin(ended_ + 1) > ended_ + 1 ? halt_at(ended_ + 1) : halt_);
      if (ended_ > began_) at = ended_;
    }
    end_cut(follower_.size() - 1);
  }

 private:
  std::int32_t next_begin(std::int32_t at) const {
    return workspace::next_reachable(ws_, follower_, at, options_);
  }

  FollowCut halt_at(std::int32_t sample) const {
    FollowCut halt;
    workspace::start_postures(ws_, follower_, sample, {}, options_, halt);
    return halt;
  }

  /// From a sample on nothing is followed. What is cut for another reason is another cut.
  void cut_from(std::int32_t first, FollowCut halt) {
    if (cutting_) {
      FollowCut& open = cuts_.back();
      if (open.reason == halt.reason || open.first == first) return;
      open.last = first;
    }
    halt.first = first;
    cuts_.push_back(halt);
    cutting_ = true;
  }

  void end_cut(std::int32_t last) {
    if (!cutting_) return;
    cuts_.back().last = last;
    // A stretch that goes on from where another ended, in another posture, leaves nothing out.
    if (last <= cuts_.back().first && last != follower_.size() - 1) cuts_.pop_back();
    cutting_ = false;
  }

  /// The longest stretch from a sample on, by the way there taken in; false where there is none
  /// with `halt` set.
  bool begin(std::int32_t sample, FollowCut& halt) {
    struct Option {
      Stretch stretch;
      std::optional<JointMatrix> way;
    };
    const bool here = rows_.empty();
    // A stretch that begins where another ended is to get farther than that.
    const std::int32_t least = !here && rows_.back().sample == sample ? sample + 1 : sample;
    std::vector<Option> found;
    halt = {};
    halt.reason = CutReason::kUnreachable;
    const auto consider = [&](const VectorXd& q, std::optional<JointMatrix> way) {
      Stretch stretch = follower_.follow(q, sample);
      const bool worth = stretch.complete || follower_.length(stretch) >= options_.shortest;
      if (stretch.rows.empty() || stretch.last < least || !worth) {
        halt = stretch.halt;
        return false;
      }
      found.push_back({std::move(stretch), std::move(way)});
      return found.back().stretch.complete;
    };
    bool whole = false;
    if (!here && least == sample) {
      auto way = transit_.stepped(rows_.back().q, rows_.back().sample, sample);
      if (way) {
        const VectorXd q = way->bottomRows(1).transpose();
        whole = consider(q, std::move(way));
      }
    }
    if (!whole) {
      std::span<const double> near = options_.q_start;
      if (!here) near = {rows_.back().q.data(), static_cast<std::size_t>(rows_.back().q.size())};
      for (const VectorXd& q :
           workspace::start_postures(ws_, follower_, sample, near, options_, halt)) {
        if (consider(q, std::nullopt)) break;
      }
    }
    std::ranges::stable_sort(found, std::ranges::greater{},
                             [](const Option& one) { return one.stretch.last; });
    for (Option& option : found) {
      if (!here && !option.way) {
        option.way = transit_.planned(rows_.back().q, rows_.back().sample,
                                      option.stretch.rows.front().q, sample);
      }
      if (!here && !option.way) {
        halt.reason = CutReason::kNoTransit;
        continue;
      }
      if (!append_way(option.way, option.stretch)) continue;
      append(std::move(option.stretch));
      return true;
    }
    return false;
  }

  /// Rows in transit; the last leg, to where the stretch begins, is looked at once more: the way
  /// ends near to it.
  bool append_way(const std::optional<JointMatrix>& way, const Stretch& stretch) {
    if (!way) return true;
    JointMatrix leg(2, way->cols());
    leg << way->bottomRows(1), stretch.rows.front().q.transpose();
    if (!ws_.check_motion(view_of(leg), {.tip_contact = follower_.tip_contact()}).free) {
      return false;
    }
    for (Index i = 1; i < way->rows(); ++i) {
      const VectorXd q = way->row(i).transpose();
      if ((q - rows_.back().q).cwiseAbs().maxCoeff() < kSmallest) continue;
      if ((q - stretch.rows.front().q).cwiseAbs().maxCoeff() < kSmallest) continue;
      rows_.push_back({q, -1, 0.0});
    }
    return true;
  }

  void append(Stretch stretch) {
    for (PathRow& row : stretch.rows) {
      const bool same =
          !rows_.empty() && (row.q - rows_.back().q).cwiseAbs().maxCoeff() < kSmallest;
      if (same) rows_.pop_back();
      rows_.push_back(std::move(row));
    }
    began_ = stretch.first;
    ended_ = stretch.last;
    complete_ = stretch.complete;
    halt_ = stretch.halt;
  }

  const Workspace& ws_;
  const FollowOptions& options_;
  PathFollower& follower_;
  workspace::Transit transit_;
  std::vector<PathRow> rows_;
  std::vector<FollowCut> cuts_;
  std::int32_t began_ = 0, ended_ = 0;
  bool complete_ = true, cutting_ = false;
  FollowCut halt_;
};

/// As long as the tool path takes; in transit, as the tip's speed there allows.
std::vector<double> least_durations(const Workspace& ws, const ToolPath& path,
                                    const std::vector<PathRow>& rows, const JointMatrix& q,
                                    const FollowOptions& options) {
  std::vector<double> least =
      workspace::tip_durations(ws.arm(), q, options.transit_speed, options.transit_rate);
  const auto time_at = [&](const PathRow& row) {
    const auto j = static_cast<std::size_t>(row.sample);
    const double from = path.time[j];
    return row.fraction > 0.0 ? from + row.fraction * (path.time[j + 1] - from) : from;
  };
  for (std::size_t i = 0; i < least.size(); ++i) {
    const bool on_path = rows[i].sample >= 0 && rows[i + 1].sample >= rows[i].sample &&
                         !(rows[i].fraction == 0.0 && rows[i + 1].fraction == 0.0 &&
                           rows[i].sample == rows[i + 1].sample);
    if (on_path) least[i] = time_at(rows[i + 1]) - time_at(rows[i]);
  }
  return least;
}

Followed assembled(const Workspace& ws, const ToolPath& path, const PathFollower& follower,
                   const std::vector<PathRow>& rows, const FollowOptions& options) {
  Followed followed;
  followed.q.resize(std::ssize(rows), ws.arm().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    followed.q.row(static_cast<Index>(i)) = rows[i].q.transpose();
    followed.sample.push_back(rows[i].sample);
    followed.fraction.push_back(rows[i].fraction);
    if (rows[i].sample < 0) continue;
    const Pose tip =
        row_frames(ws.arm(), {rows[i].q.data(), static_cast<std::size_t>(rows[i].q.size())})
            .world_from_tool;
    const workspace::TipError error =
        workspace::tip_error(tip, follower.target(rows[i].sample, rows[i].fraction));
    followed.position_error = std::max(followed.position_error, error.distance());
    followed.angle_error = std::max(followed.angle_error, error.angle());
  }
  if (rows.empty()) return followed;
  const std::vector<double> velocity =
      options.velocity.empty() ? default_limits(ws.arm()).velocity : options.velocity;
  const std::vector<double> acceleration =
      options.acceleration.empty() ? default_acceleration(ws.arm()) : options.acceleration;
  followed.time = workspace::row_times(followed.q, velocity, acceleration,
                                       least_durations(ws, path, rows, followed.q, options));
  for (double& time : followed.time) time += options.time;
  return followed;
}

}  // namespace

std::string_view to_text(CutReason reason) {
  switch (reason) {
    case CutReason::kUnreachable:
      return "unreachable";
    case CutReason::kLimit:
      return "limit";
    case CutReason::kCollision:
      return "collision";
    case CutReason::kSingular:
      return "singular";
    case CutReason::kNoTransit:
      return "no_transit";
  }
  return "unknown";
}

void FollowOptions::check(const Arm& arm) const {
  check_positive("position_tolerance", position_tolerance);
  check_positive("angle_tolerance", angle_tolerance);
  check_positive("step", step);
  check_positive("lift", lift);
  check_not_negative("shortest", shortest);
  check_positive("transit_speed", transit_speed);
  check_positive("transit_rate", transit_rate);
  check_range("candidates", candidates, 1, 1000);
  MoveOptions shared;
  shared.clearance = clearance;
  shared.influence = influence;
  shared.velocity = velocity;
  shared.acceleration = acceleration;
  shared.time = time;
  shared.check(arm);
  if (q_start.empty()) return;
  check_joint_values(arm, {q_start.data(), 1, static_cast<Index>(q_start.size())}, "q_start");
}

Followed follow_toolpath(const Workspace& ws, const ToolPath& path, const FollowOptions& options) {
  options.check(ws.arm());
  check_path(path);
  if (ws.moves()) {
    throw_argument("workspace", "a vehicle and keep-outs at rest while a path is followed",
                   "one that moves");
  }
  const workspace::Bodies bodies = workspace::make_bodies(ws.arm(), ws.surroundings());
  PathFollower follower(ws, bodies, path, options);
  FollowedRows rows(ws, follower, options);
  rows.run();
  Followed followed = assembled(ws, path, follower, rows.rows(), options);
  followed.cut = std::move(rows.cuts());
  return followed;
}

}  // namespace bathyal
