// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/internal/tip_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/identify/fit/redundancy.hpp"
#include "bathyal/identify/model/nearest_pose.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kPosesPerChunk = 128;

void set_priors(ArmColumns& columns, const ForecastOptions& options) {
  for (std::size_t i = 0; i < columns.columns.size(); ++i) {
    const Place& place = columns.places[i];
    columns.columns[i].prior_std = !is_row(place)     ? options.tool_prior
                                   : is_length(place) ? options.length_prior
                                                      : options.angle_prior;
  }
}

/// Where joint values are drawn from.
struct Range {
  double low;
  double high;
};

Range range_of(const Arm& arm, Index coordinate, double length) {
  const double lower = arm.lower()[coordinate];
  const double upper = arm.upper()[coordinate];
  const bool slides = std::any_of(arm.joints().begin(), arm.joints().end(), [&](const Joint& j) {
    return j.coordinate == coordinate && j.type == JointType::kPrismatic;
  });
  const double half = slides ? length : std::numbers::pi;
  if (std::isfinite(lower) && std::isfinite(upper) && (slides || upper - lower <= 2.0 * half)) {
    return {lower, upper};
  }
  const double middle = std::max(lower + half, std::min(0.0, upper - half));
  return {middle - half, middle + half};
}

}  // namespace

void check_workspace(const Arm& arm, const ForecastOptions& options) {
  if (options.workspace.rows() > 0 && options.workspace.cols() != arm.size()) {
    throw_argument("workspace", std::to_string(arm.size()) + " columns",
                   std::to_string(options.workspace.cols()));
  }
}

TouchModel make_touch_model(const Arm& arm, const Measurement& measurement,
                            const ForecastOptions& options) {
  const ColumnChoice choice{options.parametrization, options.nearly_parallel, false};
  TouchModel model{make_columns(arm, measurement, {arm.base()}, {arm.tool()}, {}, choice), {}};
  set_priors(model.columns, options);
  const std::vector<GaugeColumn> gauge =
      find_gauge(model.columns, measurement, choice, measurement.in_world(), {});
  for (int i = 0; i < static_cast<int>(model.columns.columns.size()); ++i) {
    const bool left = std::any_of(gauge.begin(), gauge.end(),
                                  [i](const GaugeColumn& g) { return g.column == i; });
    if (!left) model.free.push_back(i);
  }
  return model;
}

Eigen::MatrixXd tip_derivatives(const TouchModel& model, const RowMatrix& q, int num_threads) {
  const auto columns = static_cast<Index>(model.free.size());
  const TipWalk walk(model.columns, model.columns.nominal(), model.free);
  Eigen::MatrixXd out(columns, 3 * q.rows());
  parallel_for(static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 WalkFrames frames;
                 Eigen::Matrix3Xd shift(3, columns);
                 for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
                   walk.tip(q.row(i).data(), kNoRow, 0, 0, frames, shift.data(), nullptr, 3);
                   out.middleCols<3>(3 * i) = shift.transpose();
                 }
               });
  for (Index c = 0; c < columns; ++c) out.row(c) *= model.columns.columns[model.free[c]].scale;
  return out;
}

RowMatrix settled_on(const TouchModel& model, const RowMatrix& q, const Eigen::Matrix3Xd& targets,
                     int num_threads) {
  RowMatrix out(q.rows(), q.cols());
  const TipWalk walk(model.columns, model.columns.nominal(), {});
  parallel_for(static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 WalkFrames frames;
                 for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
                   const auto miss = [&](const Vec3& tip) { return Vec3(targets.col(i) - tip); };
                   out.row(i) = nearest_pose(walk, q.row(i), kNoRow, 0, 0, frames, miss);
                 }
               });
  return out;
}

Eigen::Matrix3Xd tips_of(const TouchModel& model, const RowMatrix& q, int num_threads) {
  Eigen::Matrix3Xd tips(3, q.rows());
  const TipWalk walk(model.columns, model.columns.nominal(), {});
  parallel_for(
      static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
      [&](std::size_t begin, std::size_t end) {
        WalkFrames frames;
        for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
          tips.col(i) =
              walk.tip(q.row(i).data(), kNoRow, 0, 0, frames, nullptr, nullptr, 0).translation();
        }
      });
  return tips;
}

double length_of(const Arm& arm) {
  return std::max((arm.flange() * arm.tool()).translation().norm() + chain_length(arm), 0.1);
}

RowMatrix random_poses(const Arm& arm, Index count, std::uint64_t seed) {
  const double length = length_of(arm);
  RowMatrix q(count, arm.size());
  for (Index j = 0; j < arm.size(); ++j) {
    const Range range = range_of(arm, j, length);
    for (Index i = 0; i < count; ++i) {
      RandomStream random(seed, static_cast<std::uint64_t>(i * arm.size() + j));
      q(i, j) = random.uniform(range.low, range.high);
    }
  }
  return q;
}

}  // namespace bathyal
