// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/forecast.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/model/arm_residuals.hpp"
#include "bathyal/touch_planning/internal/tip_model.hpp"

namespace bathyal {

using namespace touch_planning;

namespace {

constexpr double kUnit = 1e-3;  ///< of singular values [m]

/// Each touch's target: the mean of the tips of its point.
Eigen::Matrix3Xd targets_of(const TouchModel& model, const Measurement& m, int num_threads) {
  const Eigen::Matrix3Xd tips = tips_of(model, m.q, num_threads);
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, m.points());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(m.points());
  for (Index i = 0; i < m.rows(); ++i) {
    sum.col(m.point[i]) += tips.col(i);
    count[m.point[i]] += 1.0;
  }
  Eigen::Matrix3Xd targets(3, m.rows());
  for (Index i = 0; i < m.rows(); ++i) targets.col(i) = sum.col(m.point[i]) / count[m.point[i]];
  return targets;
}

void fill_rank(const TouchModel& model, ArmResiduals system, TouchForecast& out) {
  system.set_equal_noise(kUnit);
  system.set_use_priors(false);
  const RankReport rank = numerical_rank(system.jacobian(model.parameters.nominal()));
  out.parameters = static_cast<int>(model.parameters.parameters.size());
  out.free = static_cast<int>(model.free.size());
  out.rank = rank.rank;
  out.singular_values = rank.singular_values;

  std::vector<Parameter> free;
  for (const int column : model.free) free.push_back(model.parameters.parameters[column]);
  for (const Eigen::VectorXd& direction : readable_directions(rank.null_space())) {
    out.null_space.push_back(describe_direction(direction, free));
    Index leading = 0;
    direction.cwiseAbs().maxCoeff(&leading);
    out.null_space_leading.push_back(free[static_cast<std::size_t>(leading)].description);
  }
  const double mean_log = rank.singular_values.head(rank.rank).array().log().mean();
  out.o1 = rank.rank == 0
               ? 0.0
               : std::exp(mean_log) / std::sqrt(static_cast<double>(system.measurement().rows()));
}

void fill_tip_std(const TouchModel& model, const ArmResiduals& system, int num_threads,
                  TouchForecast& out) {
  const auto& columns = model.parameters.parameters;
  const Eigen::MatrixXd jacobian = system.jacobian(model.parameters.nominal());
  const Eigen::MatrixXd covariance = covariance_from_qr(jacobian);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  out.log_det = 2.0 * qr.matrixQR().diagonal().head(out.free).array().abs().log().sum();

  ArmFit fit(model.parameters.arm);
  fit.arm_parameters = model.parameters;
  fit.values = model.parameters.nominal();
  const auto count = static_cast<Index>(columns.size());
  fit.covariance.setZero(count, count);
  fit.undetermined.resize(count, 0);
  for (std::size_t i = 0; i < model.free.size(); ++i) {
    for (std::size_t j = 0; j < model.free.size(); ++j) {
      const int a = model.free[i];
      const int b = model.free[j];
      fit.covariance(a, b) = covariance(i, j) * columns[a].scale * columns[b].scale;
    }
  }
  for (const Eigen::Matrix3d& c : tip_covariance(fit, out.workspace, num_threads)) {
    out.tip_std.push_back(std::sqrt(c.trace()));
  }
  std::vector<double> sorted = out.tip_std;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  out.median_tip_std = *middle;
  out.worst_tip_std = *std::max_element(sorted.begin(), sorted.end());
}

}  // namespace

void ForecastOptions::check() const {
  check_range("nearly_parallel", nearly_parallel, 0.0, 0.5);
  check_positive("noise", noise);
  check_positive("length_prior", length_prior);
  check_positive("angle_prior", angle_prior);
  check_positive("tool_prior", tool_prior);
  if (!workspace.allFinite()) throw_argument("workspace", "finite numbers", "nan or inf");
  constexpr int kMostPoses = 1'000'000;
  check_range("workspace_poses", workspace_poses, 1, kMostPoses);
}

TouchForecast forecast_touches(const Arm& arm, const Touches& touches,
                               const ForecastOptions& options) {
  options.check();
  Measurement m = to_measurement(arm, touches);
  if (m.tools > 1 || m.stations > 1 || !m.plane_names.empty()) {
    throw_argument("touches", "those of points, with one tool, from one place",
                   "several tools or stations, or touched planes");
  }
  check_workspace(arm, options);
  TouchForecast out;
  out.workspace = options.workspace.rows() > 0
                      ? options.workspace
                      : random_poses(arm, options.workspace_poses, options.seed);
  const TouchModel model = make_touch_model(arm, m, options);
  m.q =
      joints_on_targets(model, m.q, targets_of(model, m, options.num_threads), options.num_threads);

  ArmResiduals system(model.parameters, m, Criterion::kCentroid, false, options.num_threads);
  system.set_free(model.free);
  system.set_noise({options.noise, options.noise}, model.parameters.nominal());
  fill_rank(model, system, out);
  fill_tip_std(model, system, options.num_threads, out);
  return out;
}

}  // namespace bathyal
