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

namespace bathyal::touch_planning {
namespace {

constexpr std::size_t kPosesPerChunk = 128;

void set_priors(ArmParameters& parameters, const ForecastOptions& options) {
  for (std::size_t i = 0; i < parameters.parameters.size(); ++i) {
    const ParameterSlot& place = parameters.slots[i];
    parameters.parameters[i].prior_std = !is_row(place)     ? options.tool_prior
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
  const ParameterChoice choice{options.parametrization, options.nearly_parallel, false};
  TouchModel model{make_parameters(arm, measurement, {arm.base()}, {arm.tool()}, {}, choice), {}};
  set_priors(model.parameters, options);
  const std::vector<RedundantParameter> redundant =
      find_redundant(model.parameters, measurement, choice, measurement.in_world(), {});
  for (int i = 0; i < static_cast<int>(model.parameters.parameters.size()); ++i) {
    const bool is_redundant =
        std::any_of(redundant.begin(), redundant.end(),
                    [i](const RedundantParameter& g) { return g.column == i; });
    if (!is_redundant) model.free.push_back(i);
  }
  return model;
}

Eigen::MatrixXd tip_derivatives(const TouchModel& model, const RowMatrix& q, int num_threads) {
  const auto columns = static_cast<Index>(model.free.size());
  const ChainDerivatives chain(model.parameters, model.parameters.nominal(), model.free);
  Eigen::MatrixXd out(columns, 3 * q.rows());
  parallel_for(static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 ChainFrames frames;
                 Eigen::Matrix3Xd shift(3, columns);
                 for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
                   chain.tip(q.row(i).data(), kNoRow, 0, 0, frames, shift.data(), nullptr, 3);
                   out.middleCols<3>(3 * i) = shift.transpose();
                 }
               });
  for (Index c = 0; c < columns; ++c)
    out.row(c) *= model.parameters.parameters[model.free[c]].scale;
  return out;
}

RowMatrix joints_on_targets(const TouchModel& model, const RowMatrix& q,
                            const Eigen::Matrix3Xd& targets, int num_threads) {
  RowMatrix out(q.rows(), q.cols());
  const ChainDerivatives chain(model.parameters, model.parameters.nominal(), {});
  parallel_for(static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 ChainFrames frames;
                 for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
                   const auto miss = [&](const Vec3& tip) { return Vec3(targets.col(i) - tip); };
                   out.row(i) = nearest_pose(chain, q.row(i), kNoRow, 0, 0, frames, miss);
                 }
               });
  return out;
}

Eigen::Matrix3Xd tips_of(const TouchModel& model, const RowMatrix& q, int num_threads) {
  Eigen::Matrix3Xd tips(3, q.rows());
  const ChainDerivatives chain(model.parameters, model.parameters.nominal(), {});
  parallel_for(
      static_cast<std::size_t>(q.rows()), kPosesPerChunk, num_threads,
      [&](std::size_t begin, std::size_t end) {
        ChainFrames frames;
        for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
          tips.col(i) =
              chain.tip(q.row(i).data(), kNoRow, 0, 0, frames, nullptr, nullptr, 0).translation();
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

}  // namespace bathyal::touch_planning
