// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/internal/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/arm/inverse.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal::touch_planning {
namespace {

constexpr int kMaxRounds = 8;  ///< of drawing poses
// Independent random streams: draws of one do not depend on those of another.
constexpr std::uint64_t kWorkspaceStream = 0;
constexpr std::uint64_t kPointStream = std::uint64_t{1} << 32U;
constexpr std::uint64_t kCandidateStream = std::uint64_t{2} << 32U;

/// A seed of its own for the `number`-th draw of a kind.
std::uint64_t stream(const PlanTouchesOptions& options, std::uint64_t kind, int number) {
  return RandomStream(options.forecast.seed, kind + static_cast<std::uint64_t>(number)).next();
}

JointView view(const RowMatrix& q) { return {q.data(), q.rows(), q.cols()}; }

RowMatrix rows_where(const RowMatrix& q, const std::vector<bool>& keep) {
  RowMatrix out(std::count(keep.begin(), keep.end(), true), q.cols());
  Index row = 0;
  for (Index i = 0; i < q.rows(); ++i) {
    if (keep[static_cast<std::size_t>(i)]) out.row(row++) = q.row(i);
  }
  return out;
}

RowMatrix below(const RowMatrix& above, const RowMatrix& rows) {
  RowMatrix out(above.rows() + rows.rows(), rows.cols());
  out << above, rows;
  return out;
}

/// `rows` without those of `known` and without repetition.
RowMatrix new_rows(const RowMatrix& known, const RowMatrix& rows) {
  constexpr double kSame = 1e-6;  // [rad], [m]
  RowMatrix all = below(known, rows);
  Index count = known.rows();
  for (Index i = known.rows(); i < all.rows(); ++i) {
    bool old = false;
    for (Index j = 0; j < count && !old; ++j) {
      old = (all.row(j) - all.row(i)).cwiseAbs().maxCoeff() < kSame;
    }
    if (!old) all.row(count++) = all.row(i).eval();
  }
  return all.middleRows(known.rows(), count - known.rows());
}

bool above_floor(const Arm& arm, const double* q, double floor, RowFrames& frames) {
  compute_row_frames(arm, {q, static_cast<std::size_t>(arm.size())}, frames);
  // The base itself is fixed.
  return frames.world_from_tool.translation().z() >= floor &&
         std::all_of(frames.world_from_row.begin() + 1, frames.world_from_row.end(),
                     [&](const Pose& pose) { return pose.translation().z() >= floor; });
}

/// Poses within the limits with the tip on `point`, from each of `starts` that converges.
RowMatrix solved_onto(const Arm& arm, const TouchModel& model, const Vec3& point,
                      const RowMatrix& starts, int num_threads) {
  const RowMatrix target = Pose(Eigen::Translation3d(point)).matrix();  // only the position counts
  std::vector<double> targets;
  for (Index i = 0; i < starts.rows(); ++i) {
    targets.insert(targets.end(), target.data(), target.data() + 16);
  }
  const InverseResult found =
      inverse(arm, targets, view(starts),
              {.task = InverseTask::kPosition, .max_starts = 1, .num_threads = num_threads});
  std::vector<bool> keep;
  for (const InverseStatus status : found.status) keep.push_back(status == InverseStatus::kReached);
  const RowMatrix reached = rows_where(found.q, keep);
  const RowMatrix solved =
      joints_on_targets(model, reached, point.replicate(1, reached.rows()), num_threads);
  return rows_where(solved, within_limits(arm, view(solved)));
}

std::string point_text(const Vec3& point, int number) {
  return "point " + std::to_string(number) + " at (" + to_text(point.x()) + ", " +
         to_text(point.y()) + ", " + to_text(point.z()) + ")";
}

}  // namespace

RowMatrix allowed_rows(const Arm& arm, const RowMatrix& q, const PlanTouchesOptions& options) {
  RowMatrix out = q;
  if (options.floor) {
    std::vector<bool> keep;
    RowFrames frames;
    for (Index i = 0; i < q.rows(); ++i) {
      keep.push_back(above_floor(arm, q.row(i).data(), *options.floor, frames));
    }
    out = rows_where(out, keep);
  }
  if (!options.feasible || out.rows() == 0) return out;
  const std::vector<bool> answers = options.feasible(out);
  if (answers.size() != static_cast<std::size_t>(out.rows())) {
    throw_argument("feasible", "an answer for each of " + std::to_string(out.rows()) + " poses",
                   std::to_string(answers.size()));
  }
  return rows_where(out, answers);
}

RowMatrix allowed_workspace(const Arm& arm, const PlanTouchesOptions& options) {
  const Index wanted = options.forecast.workspace_poses;
  RowMatrix out(0, arm.size());
  for (int round = 0; round < kMaxRounds && out.rows() < wanted; ++round) {
    const RowMatrix drawn = random_poses(arm, wanted, stream(options, kWorkspaceStream, round));
    out = below(out, allowed_rows(arm, drawn, options));
  }
  if (out.rows() == 0) {
    throw_argument(options.feasible ? "feasible" : "floor", "some of the arm's poses",
                   "none of " + std::to_string(kMaxRounds * wanted) + " drawn at random");
  }
  return out.topRows(std::min(wanted, out.rows()));
}

RowMatrix poses_on_point(const Arm& arm, const TouchModel& model, const Vec3& point, int number,
                         const PlanTouchesOptions& options) {
  const Index wanted = options.candidates;
  Index reached = 0;
  RowMatrix out(0, arm.size());
  for (int round = 0; round < kMaxRounds && out.rows() < wanted; ++round) {
    const RowMatrix starts =
        random_poses(arm, wanted, stream(options, kCandidateStream, kMaxRounds * number + round));
    const RowMatrix there = solved_onto(arm, model, point, starts, options.forecast.num_threads);
    reached += there.rows();
    out = below(out, allowed_rows(arm, new_rows(out, there), options));
  }
  if (reached == 0) {
    throw_argument("points", "points that the arm reaches",
                   point_text(point, number) +
                       ", reached "
                       "by none of " +
                       std::to_string(kMaxRounds * wanted) + " tries");
  }
  if (out.rows() == 0) {
    throw_argument(
        options.feasible ? "feasible" : "floor", "some of the poses that touch each point",
        "none of " + std::to_string(reached) + " that touch " + point_text(point, number));
  }
  return out.topRows(std::min(wanted, out.rows()));
}

Eigen::Matrix3Xd choose_points(const Arm& arm, const TouchModel& model, const RowMatrix& workspace,
                               const PlanTouchesOptions& options) {
  constexpr Index kTrialPoints = 80;       // that are looked at
  constexpr Index kTries = 48;             // poses to bring onto each of them
  constexpr double kReachableShare = 0.8;  // of what the best place has
  constexpr double kMaxDistance = 0.5;     // of the length of the arm: measurable by hand
  const RowMatrix starts = random_poses(arm, kTries, stream(options, kPointStream, 0));
  const Index trials = std::min(kTrialPoints, workspace.rows());
  const Eigen::Matrix3Xd tips =
      tips_of(model, workspace.topRows(trials), options.forecast.num_threads);
  Eigen::Matrix3Xd rounded = (tips * 100.0).array().round() / 100.0;
  if (options.floor) rounded.row(2) = rounded.row(2).cwiseMax(*options.floor);

  std::vector<Index> reached;
  for (Index i = 0; i < trials; ++i) {
    const RowMatrix there =
        solved_onto(arm, model, rounded.col(i), starts, options.forecast.num_threads);
    reached.push_back(allowed_rows(arm, there, options).rows());
  }
  const auto best = std::max_element(reached.begin(), reached.end());
  if (*best == 0) {
    throw_argument("num_points", "points that the arm reaches",
                   "none of " + std::to_string(trials) + " tried; name them as `points`");
  }
  std::vector<Index> remaining;
  for (Index i = 0; i < trials; ++i) {
    const bool well =
        static_cast<double>(reached[i]) >= kReachableShare * static_cast<double>(*best);
    const double apart = (rounded.col(i) - rounded.col(best - reached.begin())).norm();
    if (well && apart <= kMaxDistance * length_of(arm)) remaining.push_back(i);
  }
  // The best one, then always the one farthest from those chosen.
  std::vector<Index> chosen{best - reached.begin()};
  while (chosen.size() < static_cast<std::size_t>(options.num_points)) {
    const auto distance = [&](Index i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Index other : chosen) {
        nearest = std::min(nearest, (rounded.col(i) - rounded.col(other)).norm());
      }
      return nearest;
    };
    const Index next = *std::max_element(remaining.begin(), remaining.end(), [&](Index a, Index b) {
      return distance(a) < distance(b);
    });
    if (distance(next) == 0.0) break;
    chosen.push_back(next);
  }
  return rounded(Eigen::all, chosen);
}

}  // namespace bathyal::touch_planning
